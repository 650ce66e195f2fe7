// What a straight rod's stiffness matrix alone must know: the loads at which it buckles and the frequencies
// at which it swings.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "acus/needle/buckling.h"
#include "acus/needle/rod_motion.h"

namespace {

using namespace acus;
using namespace acus::needle;
using std::numbers::pi;

struct Straight {
  NeedleSpec spec;
  Rod rod;
  Pose hub;
  RodState state;
  RodMatrix stiffness;
};

// The needle of Table I, pressed together along its axis by `load` [N] at the ends.
Straight straight(Support support, int edges, double load = 0.0) {
  Straight s;
  s.spec.support = support;
  s.spec.imperfection = 0.0;
  s.rod = build_rod(s.spec, edges);
  s.state = unloaded_rod(s.rod, s.hub);
  for (Vec3& x : s.state.position) x *= 1.0 - load / s.rod.axial;
  s.stiffness = RodMatrix(s.rod.unknowns());
  std::vector<double> force(s.rod.unknowns());
  rod_forces_into(force, s.stiffness, 1.0, 1.0, s.rod, s.state, s.hub, s.hub);
  return s;
}

bool tip_held(Support support) { return support != Support::clamped_free; }

bool stands(Support support, int edges, double load) {
  Straight s = straight(support, edges, load);
  constexpr double vice = 1e9;  // N/m
  for (const int node : {0, edges})
    for (int k = 0; k < 3; ++k)
      if (node == 0 || k == 2 || tip_held(support))
        s.stiffness.add(place_at(node) + k, place_at(node) + k, vice);
  return s.stiffness.factor();
}

// The load at which the matrix of the rod between its supports ceases to be definite. N
double buckling_load(Support support, int edges) {
  double below = 0.0, above = 10.0;
  while (above - below > 1e-9) {
    const double middle = 0.5 * (below + above);
    (stands(support, edges, middle) ? below : above) = middle;
  }
  return below;
}

class RodModes : public testing::TestWithParam<Support> {};
INSTANTIATE_TEST_SUITE_P(Rod, RodModes, testing::ValuesIn(all_supports));

TEST_P(RodModes, buckle_at_eulers_load_with_an_error_of_second_order) {
  const double exact = critical_load(bending_rigidity(NeedleSpec{}), NeedleSpec{}.length, GetParam());
  double last_error = 0.0;
  for (const int edges : {10, 20, 40, 80}) {
    // An extensible column buckles at a load that is P / EA higher: 1e-5 here.
    const double error = buckling_load(GetParam(), edges) / exact - 1.0;
    if (edges == 40) {
      EXPECT_LT(std::abs(error), 5e-3);
    }
    if (edges > 10) {
      EXPECT_NEAR(last_error / error, 4.0, 0.3) << edges;
    }
    last_error = error;
  }
}

// Frequencies [rad/s], lowest first, of the unknowns `free` alone.
Eigen::VectorXd frequencies(const Straight& s, const std::vector<int>& free) {
  const int n = static_cast<int>(free.size());
  Eigen::MatrixXd k(n, n), m = Eigen::MatrixXd::Zero(n, n);
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j)
      k(i, j) = std::abs(free[i] - free[j]) <= rod_band ? s.stiffness.at(free[i], free[j]) : 0.0;
    m(i, i) = inertia(s.rod, free[i]);
  }
  return Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd>(k, m, Eigen::EigenvaluesOnly)
      .eigenvalues()
      .cwiseSqrt();
}

// (beta L)^2 of the first three modes (Blevins, Formulas for Natural Frequency and Mode Shape, 1979, Table
// 8-1).
std::array<double, 3> blevins(Support support) {
  const auto squares = [](double a, double b, double c) { return std::array{a * a, b * b, c * c}; };
  switch (support) {
    case Support::pinned_pinned:
      return squares(pi, 2.0 * pi, 3.0 * pi);
    case Support::clamped_pinned:
      return squares(3.92660231, 7.06858275, 10.21017612);
    case Support::clamped_clamped:
      return squares(4.73004074, 7.85320462, 10.9956078);
    case Support::clamped_free:
      return squares(1.87510407, 4.69409113, 7.85475744);
  }
  return {};
}

TEST_P(RodModes, swing_sideways_as_a_beam_does) {
  const Straight s = straight(GetParam(), 40);
  for (int across = 0; across < 2; ++across) {
    std::vector<int> free;
    for (int i = 1; i < s.rod.edges + (tip_held(GetParam()) ? 0 : 1); ++i)
      free.push_back(place_at(i) + across);
    const Eigen::VectorXd found = frequencies(s, free);
    const double unit =
        std::sqrt(s.rod.bending / (s.spec.density * section_area(s.spec))) / (s.spec.length * s.spec.length);
    for (int mode = 0; mode < 3; ++mode)
      EXPECT_NEAR(found[mode] / unit / blevins(GetParam())[mode], 1.0, 0.01) << mode;
  }
}

// A clamped shaft with a free end turns to and fro at (2 n - 1) pi / (2 L) sqrt(G / density) (Blevins 1979,
// Table 8-19), and a bar shakes along at the same with E.
TEST(RodModes, turn_and_shake_as_a_shaft_does) {
  const Straight s = straight(Support::clamped_free, 40);
  std::vector<int> spins, along;
  for (int j = 0; j < s.rod.edges; ++j) {
    spins.push_back(spin_at(j));
    along.push_back(place_at(j + 1) + 2);
  }
  const double shear_modulus = s.spec.youngs_modulus / (2.0 * 1.3);
  for (int mode = 0; mode < 3; ++mode) {
    const double wave = (2 * mode + 1) * pi / (2.0 * s.spec.length);
    EXPECT_NEAR(frequencies(s, spins)[mode] / (wave * std::sqrt(shear_modulus / s.spec.density)), 1.0, 0.01);
    EXPECT_NEAR(frequencies(s, along)[mode] / (wave * std::sqrt(s.spec.youngs_modulus / s.spec.density)), 1.0,
                0.01);
  }
}

}  // namespace
