// A contact spring far stiffer than the tissue must not magnify what a solve leaves into the felt force.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "acus/sim/simulation.h"

namespace acus {
namespace {

// N, step by step, of a column pressed on tissue by 4 mm.
std::vector<double> felt(double stiffness, double tolerance) {
  Scene scene;
  scene.needle_model = NeedleModel::column;
  scene.tissue.tetrahedra = 1000;
  scene.contact.near_field = false;
  scene.contact.stiffness = stiffness;
  scene.run.solver_tolerance = tolerance;
  Result<Simulation> simulation = Simulation::build(scene);
  std::vector<double> forces;
  constexpr int steps = 200;
  constexpr double way = 2e-5;  // m
  for (int i = 1; i <= steps; ++i) forces.push_back(simulation->step(i * way).hand_force);
  EXPECT_EQ(simulation->frame().health, Health::good);
  return forces;
}

TEST(StiffContact, is_felt_within_half_a_percent) {
  const double tolerance = RunScene{}.solver_tolerance;
  for (const double stiffness : {1e4, 1e6, 1e7}) {
    const std::vector<double> force = felt(stiffness, tolerance), exact = felt(stiffness, 1e-10);
    double most = 0.0, apart = 0.0;
    for (std::size_t i = 0; i < force.size(); ++i) {
      most = std::max(most, std::abs(exact[i]));
      apart = std::max(apart, std::abs(force[i] - exact[i]));
    }
    EXPECT_GT(most, 0.1);
    EXPECT_LT(apart, 5e-3 * most) << stiffness << " N/m";
  }
}

}  // namespace
}  // namespace acus
