#include "acus/tissue/pressure.h"

#include "acus/tissue/pair_sums.h"

namespace acus::tissue {
namespace {

using numeric::Range;

template <class Real>
ACUS_INLINE void add_pressures(Real* to, const TissueModel& m, Range elements,
                               const std::vector<Real>& gradient, const std::vector<Real>& quarter_volume,
                               const numeric::NodeVectorOf<Real>& field) {
  using Lane = typename LaneOf<Real>::type;
  add_pairs(
      to, m, elements,
      [&, q = ElementNumbers<Real>(gradient, 9), quarter = ElementNumbers<Real>(quarter_volume, 1) ](
          std::size_t pair, int part, const Offsets* offsets, Lane(*node)[4]) mutable
      __attribute__((always_inline)) {
        Lane sum[2][4], q_of_side[9], force[4][4] = {};
        sum_corners(sum, field.data(), offsets);
        ACUS_UNROLL
        for (int side = 0; side < 2; ++side) {
          const std::size_t first = element_of_pair(pair, side);
          q.go_to(first, part), quarter.go_to(first, part);
          for (int k = 0; k < 9; ++k) q_of_side[k] = q[k];
          corner_forces_of_pressure(force, quarter[0] * sum[side][3], q_of_side);
          put_corners(node, force, side);
        }
      });
}

}  // namespace

ACUS_KERNEL void press(double* to, const TissueModel& m, Range elements, const std::vector<double>& gradient,
                       const numeric::NodeVector& field) {
  add_pressures(to, m, elements, gradient, m.quarter_volume, field);
}
ACUS_KERNEL void press(float* to, const TissueModel& m, Range elements, const std::vector<float>& gradient,
                       const numeric::NodeVectorOf<float>& field) {
  add_pressures(to, m, elements, gradient, m.single_quarter_volume, field);
}

}  // namespace acus::tissue
