// The tangent that a haptic loop relies on between two steps, against differences of whole runs.
#include <gtest/gtest.h>

#include <cmath>

#include "acus/sim/simulation.h"

namespace acus {
namespace {

struct Case {
  const char* name;
  double length, travel, time_step, tolerance;  // m, m, s, -
  double grip = 0.0;                            // N/m
  NeedleModel model = NeedleModel::column;
};

class HandStiffness : public testing::TestWithParam<Case> {};

Scene scene_of(const Case& c) {
  Scene scene;
  scene.needle.length = c.length;
  scene.tissue.tetrahedra = 1000;
  scene.run.time_step = c.time_step;
  scene.run.solver_tolerance = 1e-9;  // differences of forces over 0.1 um
  scene.hand.stiffness = c.grip;
  scene.needle_model = c.model;
  return scene;
}

// The hand's force after going to c.travel, and `extra` farther in the last step.
double force_after(const Case& c, double extra, double* stiffness = nullptr) {
  Result<Simulation> simulation = Simulation::build(scene_of(c));
  const double step = c.time_step * 10e-3;
  const long steps = std::lround(c.travel / step);
  for (long i = 1; i < steps; ++i) simulation->step(static_cast<double>(i) * step);
  const double force = simulation->step(static_cast<double>(steps) * step + extra).hand_force;
  if (stiffness != nullptr) {
    const std::uint64_t before = simulation->state_hash();
    *stiffness = simulation->hand_stiffness();
    EXPECT_EQ(simulation->state_hash(), before);
  }
  return force;
}

TEST_P(HandStiffness, is_the_derivative_of_the_force_with_the_travel_of_the_step) {
  const Case& c = GetParam();
  constexpr double d = 1e-7;  // m
  const double difference = (force_after(c, d) - force_after(c, -d)) / (2.0 * d);
  double stiffness = 0.0;
  force_after(c, 0.0, &stiffness);
  EXPECT_NEAR(stiffness, difference, c.tolerance * difference);
}

INSTANTIATE_TEST_SUITE_P(
    In, HandStiffness,
    testing::Values(Case{"contact", 0.15, 3e-3, 1e-3, 0.01},
                    Case{"contact_in_long_steps", 0.15, 3e-3, 10e-3, 0.02},
                    Case{"buckled", 0.2, 8e-3, 1e-3, 0.01}, Case{"inserted", 0.15, 16e-3, 5e-3, 0.01},
                    Case{"contact_through_a_grip", 0.15, 6e-3, 1e-3, 0.01, 350.0},
                    Case{"buckled_through_a_grip", 0.2, 10e-3, 1e-3, 0.01, 350.0},
                    Case{"contact_of_a_rod", 0.15, 3e-3, 1e-3, 0.01, 0.0, NeedleModel::rod},
                    Case{"bent_rod", 0.2, 8e-3, 1e-3, 0.01, 0.0, NeedleModel::rod},
                    Case{"inserted_rod", 0.15, 16e-3, 5e-3, 0.01, 0.0, NeedleModel::rod},
                    Case{"bent_rod_through_a_grip", 0.2, 10e-3, 1e-3, 0.01, 350.0, NeedleModel::rod}),
    [](const auto& of) { return std::string(of.param.name); });

// A hand that holds the hub through a spring is felt as one that takes the hub itself where the spring let it
// go.
class Grip : public testing::TestWithParam<NeedleModel> {};
INSTANTIATE_TEST_SUITE_P(Of, Grip, testing::Values(NeedleModel::column, NeedleModel::rod));

TEST_P(Grip, gives_way_by_the_force_over_its_stiffness) {
  Scene scene = scene_of({"", 0.2, 0.0, 1e-3, 0.0, 350.0, GetParam()});
  scene.contact.rupture_force = 0.66;  // it buckles, punctures and springs back on the way
  Result<Simulation> held = Simulation::build(scene);
  scene.hand.stiffness = 0.0;
  Result<Simulation> led = Simulation::build(scene);
  double largest = 0.0, apart = 0.0;
  for (int i = 1; i <= 1000; ++i) {
    const double travel = 30e-6 * i;
    const Frame& frame = held->step(travel);
    EXPECT_NEAR(frame.hand_travel, travel - frame.hand_force / 350.0, 1e-12);
    apart = std::max(apart, std::abs(led->step(frame.hand_travel).hand_force - frame.hand_force));
    largest = std::max(largest, frame.hand_force);
  }
  EXPECT_GT(largest, 0.65);
  EXPECT_LT(apart, 1e-4 * largest);
  ASSERT_EQ(held->events().size(), led->events().size());
  EXPECT_GE(held->events().size(), 3U);
}

// Nobody pushes back on a needle that touches nothing yet.
TEST(HandStiffness, is_nothing_before_the_first_step) {
  Result<Simulation> simulation = Simulation::build(scene_of({"", 0.15, 0.0, 1e-3, 0.0}));
  EXPECT_EQ(simulation->hand_stiffness(), 0.0);
}

// In the testing machine it is the column's: EA / L of a straight one, in the limit of no imperfection.
TEST(HandStiffness, of_a_straight_column_is_its_axial_stiffness) {
  Scene scene;
  scene.needle_model = NeedleModel::column;
  scene.tissue.rigid = true;
  scene.needle.length = 0.1;
  scene.needle.imperfection = 0.0;
  Result<Simulation> simulation = Simulation::build(scene);
  simulation->step(-1e-3);  // not there yet
  EXPECT_EQ(simulation->hand_stiffness(), 0.0);
  simulation->step(1e-7);
  const double area = 3.14159265358979 * scene.needle.radius * scene.needle.radius;
  EXPECT_NEAR(simulation->hand_stiffness(), scene.needle.youngs_modulus * area / 0.1,
              1e-3 * simulation->hand_stiffness());
}

}  // namespace
}  // namespace acus
