// Forces that are added up in floats against those in double.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

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

double most_apart(const numeric::NodeVector& a, const numeric::NodeVector& b) {
  double apart = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) apart = std::max(apart, std::abs(a[i] - b[i]));
  return apart;
}
double largest_of(const numeric::NodeVector& a) { return most_apart(a, numeric::NodeVector(a.size(), 0.0)); }

// Elements that are moved bodily lose no more; those that turn lose 1e-8 of a strain of one for every radian,
// and that many times the bulk modulus.
TEST_P(ForcePrecisions, single_stands_to_be_moved_and_turned) {
  const Case& of = GetParam();
  const Material material{.youngs_modulus = 1e4, .poisson_ratio = of.poisson_ratio, .density = 1e3};
  BareTissue exact(held_mesh(irregular_block(), nowhere), material, of.kind);
  const double bulk_over_shear = (1.0 + of.poisson_ratio) / (1.5 - 3.0 * of.poisson_ratio);
  constexpr double strain = 0.02;  // of jolts by 0.2 mm and more on edges of 10 mm
  const std::vector<Vec3> jolts = jolted(exact.rest, 2e-4, 3);
  for (const double shift : {0.0, 0.01, 0.1})
    for (const double turn : {0.0, 0.3, 1.0, 2.4, 3.1}) {
      const Mat3 R = Eigen::AngleAxisd(turn, Vec3(1.0, -2.0, 0.5).normalized()).toRotationMatrix();
      std::vector<Vec3> there;
      for (const Vec3& x : jolts) there.push_back(R * x + Vec3(shift, -shift, shift));
      Corotation single = build_corotation(exact.model, ForcePrecision::single);
      corotate_into(exact.corotation, exact.model, there);
      corotate_into(single, exact.model, there);  // at once
      const double bound = of.bound + 1e-8 * turn * std::max(bulk_over_shear, 1.0) / strain;
      EXPECT_LT(most_apart(single.elastic_force, exact.corotation.elastic_force),
                bound * largest_of(exact.corotation.elastic_force))
          << "moved by " << shift << " m and turned by " << turn;
    }
}

TEST_P(ForcePrecisions, single_says_so_when_a_position_is_no_number_and_recovers) {
  const Case& of = GetParam();
  const Material material{.youngs_modulus = 1e4, .poisson_ratio = of.poisson_ratio, .density = 1e3};
  const BareTissue exact(held_mesh(irregular_block(), nowhere), material, of.kind);
  Corotation single = build_corotation(exact.model, ForcePrecision::single);
  const double nan = std::numeric_limits<double>::quiet_NaN(),
               infinite = std::numeric_limits<double>::infinity();
  for (const double wrong : {nan, infinite, -infinite, 1e200}) {
    std::vector<Vec3> there = exact.rest;
    there[3].y() = wrong;
    corotate_into(single, exact.model, there);
    EXPECT_FALSE(single.finite) << wrong;
    for (int i = 0; i < 3; ++i) corotate_into(single, exact.model, exact.rest);
    EXPECT_TRUE(single.finite);
    EXPECT_LT(largest_of(single.elastic_force), 1e-9);
  }
}

// The strain of a branch that is held is forgotten by steps that are less than floats can tell apart.
TEST(SingleBranch, forgets_slowly_and_loses_nothing) {
  const Material material{.youngs_modulus = 1e4, .poisson_ratio = 0.45, .density = 1e3};
  for (const double time : {1.0, 1e3, 1e5}) {
    BareTissue held(held_mesh(irregular_block(), nowhere), material, ElementKind::nodal_pressure,
                    relaxation_step({0.5, time}, 1e-3));
    Corotation single = build_corotation(held.model, ForcePrecision::single);
    const std::vector<Vec3> there = jolted(held.rest, 5e-4, 3);
    corotate_into(single, held.branch, held.model, there);
    const double begun = single.energy;
    double spent = 0.0;
    constexpr int steps = 3000;
    for (int i = 0; i < steps; ++i) {
      corotate_into(single, held.branch, held.model, there);
      spent += single.relaxed;
    }
    Corotation elastic = build_corotation(held.model);
    corotate_into(elastic, held.model, there);
    const double of_branch = begun - elastic.energy, gone = -std::expm1(-2.0 * steps * 1e-3 / time);
    EXPECT_NEAR(single.energy + spent, begun, 1e-6 * begun) << time << " s";
    EXPECT_NEAR(begun - single.energy, gone * of_branch, 1e-3 * gone * of_branch + 1e-6 * begun)
        << time << " s";
  }
}

}  // namespace
}  // namespace acus::tissue
