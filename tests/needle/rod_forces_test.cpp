#include "acus/needle/rod_forces.h"

#include <gtest/gtest.h>

#include <random>

namespace {

using namespace acus;
using namespace acus::needle;

struct Crooked {
  Rod rod;
  RodState state;
  Pose hub, tip;
};

// A rod in disorder: bent, stretched and twisted, both ends clamped askew.
Crooked crooked(int seed, double natural) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> any;
  NeedleSpec spec;
  spec.length = 0.1;
  spec.support = Support::clamped_clamped;
  Crooked c;
  c.rod = build_rod(spec, 5);
  for (auto& turning : c.rod.natural_turning) turning = {natural * any(random), natural * any(random)};
  c.hub.tangent = Vec3(0.3, -0.2, -1.0).normalized();
  c.hub.director = c.hub.tangent.unitOrthogonal();
  c.state = unloaded_rod(c.rod, c.hub);
  std::vector<double> change(c.rod.unknowns());
  for (int i = 0; i < c.rod.unknowns(); ++i) change[i] = any(random) * (is_spin(i) ? 0.3 : 3e-3);
  displace(c.state, c.rod, change);
  c.tip.tangent = (edge(c.state, 4).normalized() + Vec3(0.2, 0.1, 0.0)).normalized();
  c.tip.director = transported(c.state.director[4], edge(c.state, 4).normalized(), c.tip.tangent);
  return c;
}

RodState moved(const Crooked& c, int unknown, double by) {
  RodState s = c.state;
  std::vector<double> change(c.rod.unknowns());
  change[unknown] = by;
  displace(s, c.rod, change);
  return s;
}

struct Evaluated {
  double energy;
  std::vector<double> force;
};
Evaluated evaluated(const Crooked& c, const RodState& s) {
  Evaluated e{0.0, std::vector<double>(c.rod.unknowns())};
  e.energy = total(rod_forces_into(e.force, c.rod, s, c.hub, c.tip));
  return e;
}

double step_of(int unknown) { return is_spin(unknown) ? 1e-5 : 1e-7; }

TEST(RodForces, are_the_slope_of_the_energy) {
  for (int seed = 1; seed <= 5; ++seed) {
    const Crooked c = crooked(seed, 0.1);
    const Evaluated here = evaluated(c, c.state);
    for (int i = 0; i < c.rod.unknowns(); ++i) {
      const double d = step_of(i);
      const double slope =
          (evaluated(c, moved(c, i, d)).energy - evaluated(c, moved(c, i, -d)).energy) / (2.0 * d);
      const double size = is_spin(i) ? 1e-2 : 1e3;  // N m, N: of the forces here
      EXPECT_NEAR(here.force[i], -slope, 1e-6 * size) << "unknown " << i << " seed " << seed;
    }
  }
}

TEST(RodForces, matrix_is_the_slope_of_the_forces) {
  for (int seed = 1; seed <= 5; ++seed) {
    const Crooked c = crooked(seed, 0.1);
    RodMatrix matrix(c.rod.unknowns());
    std::vector<double> force(c.rod.unknowns());
    rod_forces_into(force, matrix, 1.0, 1.0, c.rod, c.state, c.hub, c.tip);
    const int n = c.rod.unknowns();
    std::vector<std::vector<double>> slope;  // [unknown][force]
    for (int i = 0; i < n; ++i) {
      const double d = step_of(i);
      slope.push_back(evaluated(c, moved(c, i, d)).force);
      const auto back = evaluated(c, moved(c, i, -d)).force;
      for (int j = 0; j < n; ++j) slope[i][j] = -(slope[i][j] - back[j]) / (2.0 * d);
    }
    for (int i = 0; i < n; ++i)
      for (int j = 0; j <= i; ++j) {
        const double size = (is_spin(i) ? 1e-3 : 1.0) * (is_spin(j) ? 1e-3 : 1.0) * 2.8e6;  // EA / l
        // Carried round a loop a director comes back turned: the order of two small moves matters a little.
        EXPECT_NEAR(i - j <= rod_band ? matrix.at(i, j) : 0.0, 0.5 * (slope[i][j] + slope[j][i]), 1e-7 * size)
            << i << ' ' << j << " seed " << seed;
      }
  }
}

TEST(RodForces, vanish_for_the_unloaded_needle_wherever_it_lies) {
  NeedleSpec spec;
  spec.imperfection = 0.0;
  Pose hub;
  hub.tangent = Vec3(1.0, 2.0, -2.0) / 3.0;
  hub.director = hub.tangent.unitOrthogonal();
  const Rod rod = build_rod(spec, 12);
  std::vector<double> force(rod.unknowns());
  const RodEnergy e = rod_forces_into(force, rod, unloaded_rod(rod, hub), hub, hub);
  EXPECT_LT(total(e), 1e-18);
  for (const double f : force) EXPECT_LT(std::abs(f), 1e-7);
}

}  // namespace
