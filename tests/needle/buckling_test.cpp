#include "acus/needle/buckling.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "acus/numeric/root.h"

namespace {

using namespace acus::needle;
using std::numbers::pi;

double table_one_load(double length, Support support) {
  return critical_load(bending_rigidity(NeedleSpec{}), length, support);
}

TEST(Buckling, clamped_pinned_root_solves_tan_z_equals_z) {
  const double root =
      acus::numeric::bracketed_root([](double z) { return std::sin(z) - z * std::cos(z); }, pi, 1.5 * pi);
  EXPECT_NEAR(clamped_pinned_root, root, 1e-15 * root);
}

// Timoshenko and Gere, Theory of Elastic Stability, 2.2.
TEST(Buckling, load_factors_are_those_of_the_textbook) {
  EXPECT_EQ(critical_load_factor(Support::pinned_pinned), 1.0);
  EXPECT_NEAR(critical_load_factor(Support::clamped_pinned), 2.04575, 5e-6);
  EXPECT_EQ(critical_load_factor(Support::clamped_clamped), 4.0);
  EXPECT_EQ(critical_load_factor(Support::clamped_free), 0.25);
}

TEST(Buckling, table_one_needle_buckles_at_the_loads_of_the_papers_lengths) {
  EXPECT_NEAR(bending_rigidity(NeedleSpec{}), 1.2723e-3, 5e-8);
  struct Row {
    double length, pinned, clamped;
  };
  for (const Row& row : {Row{0.15, 0.558, 1.142}, Row{0.2, 0.314, 0.642}, Row{0.3, 0.140, 0.285}}) {
    EXPECT_NEAR(table_one_load(row.length, Support::pinned_pinned), row.pinned, 6e-4) << row.length;
    EXPECT_NEAR(table_one_load(row.length, Support::clamped_pinned), row.clamped, 6e-4) << row.length;
  }
}

TEST(Buckling, table_one_needle_buckles_at_one_newton_at_the_known_free_lengths) {
  EXPECT_NEAR(table_one_load(112.1e-3, Support::pinned_pinned), 1.0, 1e-3);
  EXPECT_NEAR(table_one_load(160.3e-3, Support::clamped_pinned), 1.0, 1e-3);
  EXPECT_NEAR(table_one_load(224.1e-3, Support::clamped_clamped), 1.0, 1e-3);
}

TEST(Buckling, give_of_the_tissue_lowers_the_load_a_little) {
  constexpr double tissue = 100.0;  // N/m
  struct Row {
    double length, lowered;
  };
  for (const Row& row : {Row{0.15, 0.008}, Row{0.2, 0.003}, Row{0.3, 0.001}}) {
    const double load = critical_load_with_lateral_spring(bending_rigidity(NeedleSpec{}), row.length, tissue);
    EXPECT_NEAR(1.0 - load / table_one_load(row.length, Support::clamped_pinned), row.lowered, 5e-4)
        << row.length;
  }
}

TEST(Buckling, lateral_spring_leads_from_a_free_tip_to_a_pinned_one) {
  const double rigidity = bending_rigidity(NeedleSpec{});
  constexpr double length = 0.2;
  const auto load = [&](double spring) {
    return critical_load_with_lateral_spring(rigidity, length, spring);
  };
  EXPECT_NEAR(load(0.0), table_one_load(length, Support::clamped_free), 1e-12);
  EXPECT_NEAR(load(1e-9), load(0.0), 1e-9);
  EXPECT_NEAR(load(1e12) / table_one_load(length, Support::clamped_pinned), 1.0, 1e-9);
  double last = load(0.0);
  for (double spring = 1e-3; spring < 1e6; spring *= 2.0) {
    EXPECT_GT(load(spring), last) << spring;
    last = load(spring);
  }
  // A weak spring raises the load by its work in the free mode w = 1 - cos(pi x / 2l):
  // dP = k w(l)^2 / (integral of w'^2) = 8 k l / pi^2 (Rayleigh).
  const double weak = 1e-6;
  EXPECT_NEAR((load(weak) - load(0.0)) / (8.0 * weak * length / (pi * pi)), 1.0, 1e-3);
}

// 22 G, regular wall: 0.7176 mm outside, 0.413 mm inside. I = pi (0.7176^4 - 0.413^4) / 64 = 0.011589 mm^4.
TEST(Buckling, tube_is_softer_than_a_rod_by_its_bore) {
  NeedleSpec tube;
  tube.radius = 0.3588e-3;
  tube.inner_radius = 0.2065e-3;
  EXPECT_NEAR(bending_rigidity(tube), 200e9 * 0.011589e-12, 1e-4 * bending_rigidity(tube));
  EXPECT_NEAR(section_area(tube), 0.27048e-6, 1e-4 * section_area(tube));  // pi (0.7176^2 - 0.413^2) / 4
}

}  // namespace
