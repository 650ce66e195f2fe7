#include "acus/tissue/stresses.h"

#include "acus/tissue/pair_sums.h"

namespace acus::tissue {
namespace {

using numeric::Range;

template <bool with_skew, class Real>
ACUS_INLINE void add(Real* to, const TissueModel& m, Range elements, const StressesOf<Real>& stresses,
                     const std::vector<Real>& gradient) {
  using Lane = typename KernelLane<Real>::type;
  const ElementNumbers<Real> gradients(gradient, 9),
      numbers(stresses.numbers, with_skew ? stress_numbers_with_skew : stress_numbers);
  add_pairs(
      to, m, elements,
      [&](std::size_t pair, int part, const Offsets*, Lane(*node)[4]) __attribute__((always_inline)) {
        Lane q[9], stress[6], force[4][4];
        ACUS_UNROLL
        for (int side = 0; side < 2; ++side) {
          const std::size_t first = element_of_pair(pair, side);
          const auto of_side = gradients.of(first, part);
          const auto s = numbers.of(first, part);
          for (int k = 0; k < 9; ++k) q[k] = of_side[k];
          for (int k = 0; k < 6; ++k) stress[k] = s[k];
          corner_forces(force, stress, q);
          if constexpr (with_skew) {
            const Lane zx = s[7], zy = s[8], zz = s[9];
            for (int i = 0; i < 3; ++i) {
              const Lane x = q[3 * i], y = q[3 * i + 1], z = q[3 * i + 2];
              force[i + 1][0] -= zy * z - zz * y;
              force[i + 1][1] -= zz * x - zx * z;
              force[i + 1][2] -= zx * y - zy * x;
            }
            balance_corner_0(force);
          }
          for (auto& corner : force) corner[3] = s[6];
          put_corners(node, force, side);
        }
      });
}

ACUS_KERNEL void add_symmetric(double* to, const TissueModel& m, Range elements, const StressesOf<double>& s,
                               const std::vector<double>& gradient) {
  add<false>(to, m, elements, s, gradient);
}
ACUS_KERNEL void add_symmetric(float* to, const TissueModel& m, Range elements, const StressesOf<float>& s,
                               const std::vector<float>& gradient) {
  add<false>(to, m, elements, s, gradient);
}
ACUS_KERNEL void add_with_skew(double* to, const TissueModel& m, Range elements, const StressesOf<double>& s,
                               const std::vector<double>& gradient) {
  add<true>(to, m, elements, s, gradient);
}
ACUS_KERNEL void add_with_skew(float* to, const TissueModel& m, Range elements, const StressesOf<float>& s,
                               const std::vector<float>& gradient) {
  add<true>(to, m, elements, s, gradient);
}

}  // namespace

template <class Real>
StressesOf<Real> build_stresses(const TissueModel& m) {
  StressesOf<Real> s;
  const std::size_t size = static_cast<std::size_t>(m.nodes) * numeric::node_stride;
  s.numbers.assign(m.corners.size() * numbers_of_stress(m), Real{});
  s.parts.assign(m.streams.count() * size, Real{});
  if (m.kind == ElementKind::nodal_pressure) s.pressure.assign(size, Real{});
  return s;
}
template StressesOf<double> build_stresses(const TissueModel& m);
template StressesOf<float> build_stresses(const TissueModel& m);

void add_forces(double* to, const TissueModel& m, Range elements, const StressesOf<double>& s,
                const std::vector<double>& gradient) {
  m.relaxation.relaxes() ? add_with_skew(to, m, elements, s, gradient)
                         : add_symmetric(to, m, elements, s, gradient);
}
void add_forces(float* to, const TissueModel& m, Range elements, const StressesOf<float>& s,
                const std::vector<float>& gradient) {
  m.relaxation.relaxes() ? add_with_skew(to, m, elements, s, gradient)
                         : add_symmetric(to, m, elements, s, gradient);
}

}  // namespace acus::tissue
