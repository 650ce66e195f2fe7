#include "acus/tissue/pressure.h"

#include "acus/tissue/pair_sums.h"

namespace acus::tissue {
namespace {

using numeric::Range;

template <class Lane, class Real>
ACUS_INLINE void add_pressures(Real* to, const TissueModel& m, Range elements,
                               const std::vector<Real>& gradient, const std::vector<Real>& quarter_volume,
                               const numeric::NodeVectorOf<Real>& field) {
  const ElementNumbers<Lane> gradients(gradient, 9), quarters(quarter_volume, 1);
  add_pairs<Lane>(to, m, elements,
                  [&](std::size_t pair, int part, const Offsets* offsets, Lane(*node)[4]) ACUS_INLINED {
                    Lane sum[2][4], q[9], force[4][4] = {};
                    sum_corners(sum, field.data(), offsets);
                    ACUS_UNROLL
                    for (int side = 0; side < 2; ++side) {
                      const std::size_t first = element_of_pair(pair, side);
                      const auto of_side = gradients.of(first, part);
                      for (int k = 0; k < 9; ++k) q[k] = of_side[k];
                      corner_forces_of_pressure(force, quarters.of(first, part)[0] * sum[side][3], q);
                      put_corners(node, force, side);
                    }
                  });
}

}  // namespace

void press(double* to, const TissueModel& m, Range elements, const std::vector<double>& gradient,
           const numeric::NodeVector& field) {
  numeric::run_kernel([&](auto bytes) ACUS_INLINED {
    add_pressures<numeric::LaneOf<double, bytes>>(to, m, elements, gradient, m.exact.quarter_volume, field);
  });
}
void press(float* to, const TissueModel& m, Range elements, const std::vector<float>& gradient,
           const numeric::NodeVectorOf<float>& field) {
  numeric::run_kernel([&](auto bytes) ACUS_INLINED {
    add_pressures<numeric::LaneOf<float, bytes>>(to, m, elements, gradient, m.single.quarter_volume, field);
  });
}

}  // namespace acus::tissue
