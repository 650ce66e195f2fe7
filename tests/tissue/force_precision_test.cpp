// Forces that are added up in floats against those in double.
#include <gtest/gtest.h>

#include "tests/tissue/irregular_block.h"
#include "tests/tissue/tissue_driver.h"

namespace acus::tissue {
namespace {

struct Case {
  ElementKind kind;
  double poisson_ratio, relaxation_share;
  double bound;  // of the largest force
};
class ForcePrecisions : public ::testing::TestWithParam<Case> {};
INSTANTIATE_TEST_SUITE_P(, ForcePrecisions,
                         ::testing::Values(Case{ElementKind::linear, 0.3, 0.0, 5e-7},
                                           Case{ElementKind::linear, 0.48, 0.5, 5e-7},
                                           Case{ElementKind::nodal_pressure, 0.48, 0.0, 5e-7},
                                           Case{ElementKind::nodal_pressure, 0.48, 0.5, 5e-7},
                                           Case{ElementKind::nodal_pressure, 0.499, 0.0, 2e-6}));

TEST_P(ForcePrecisions, single_is_exact_to_the_rounding_of_floats) {
  const Case& of = GetParam();
  const HeldMesh held = held_mesh(irregular_block(), at_bottom);
  const Material material{.youngs_modulus = 1e4, .poisson_ratio = of.poisson_ratio, .density = 1e3};
  BareTissue exact(held, material, of.kind, relaxation_step({of.relaxation_share, 0.1}, 1e-3));
  Corotation single = build_corotation(exact.model, ForcePrecision::single);
  corotate_into(single, exact.model, exact.rest);  // as BareTissue has begun
  MaxwellBranch branch = build_branch(exact.model);
  for (int step = 1; step <= 3; ++step) {
    const std::vector<Vec3> position = jolted(exact.rest, 2e-4 * step, 3);
    corotate_into(exact.corotation, exact.branch, exact.model, position);
    corotate_into(single, branch, exact.model, position);
    double largest = 0.0, error = 0.0;
    for (std::size_t i = 0; i < single.elastic_force.size(); ++i) {
      largest = std::max(largest, std::abs(exact.corotation.elastic_force[i]));
      error = std::max(error, std::abs(single.elastic_force[i] - exact.corotation.elastic_force[i]));
    }
    EXPECT_GT(largest, 0.0);
    EXPECT_LT(error, of.bound * largest) << "step " << step;
    EXPECT_NEAR(single.energy, exact.corotation.energy, of.bound * exact.corotation.energy);
    const std::vector<float>&of_single = single.single.gradient, &of_exact = exact.corotation.single.gradient;
    ASSERT_EQ(of_single.size(), of_exact.size());
    double steepest = 0.0, apart = 0.0;
    for (std::size_t i = 0; i < of_exact.size(); ++i) {
      steepest = std::max(steepest, std::abs(static_cast<double>(of_exact[i])));
      apart = std::max(apart, std::abs(static_cast<double>(of_single[i] - of_exact[i])));
    }
    EXPECT_LT(apart, 5e-7 * steepest);
  }
}

}  // namespace
}  // namespace acus::tissue
