// A step allocates nothing, whatever happens in it. This program counts every operator new.
#include <gtest/gtest.h>

#include <set>
#include <tuple>

#include "acus/sim/hand.h"
#include "acus/sim/simulation.h"
#include "tests/counted_allocations.h"

namespace acus {
namespace {

class StepAllocation : public ::testing::TestWithParam<std::tuple<Element, Coupling, NeedleModel, double>> {};
INSTANTIATE_TEST_SUITE_P(
    , StepAllocation,
    ::testing::Values(std::tuple{Element::nodal_pressure, Coupling::embedded, NeedleModel::column, 0.0},
                      std::tuple{Element::nodal_pressure, Coupling::embedded, NeedleModel::column, 0.4},
                      std::tuple{Element::linear, Coupling::embedded, NeedleModel::column, 0.0},
                      std::tuple{Element::linear, Coupling::nearest_node, NeedleModel::column, 0.0},
                      std::tuple{Element::nodal_pressure, Coupling::embedded, NeedleModel::rod, 0.4}));

// In and out again in 400 steps: contact, puncture, cutting, withdrawal.
TEST_P(StepAllocation, is_none_through_contact_puncture_and_withdrawal) {
  Scene scene;
  scene.tissue.tetrahedra = 600;
  std::tie(scene.tissue.element, scene.contact.coupling, scene.needle_model, scene.tissue.relaxation_share) =
      GetParam();
  scene.contact.rupture_force = 0.5;  // N
  if (scene.needle_model == NeedleModel::rod) {
    scene.needle.bevel_degrees = 30.0;
    scene.hand.grip = 20e-3;
    scene.guide = {.length = 80e-3, .gap = 10e-3, .friction = 1.0};
  }
  auto built = Simulation::build(scene);
  ASSERT_TRUE(built.ok()) << built.error().sentence;
  Simulation simulation = std::move(*built);
  std::set<Stage> stages;
  const double stride = 0.2e-3;  // m
  for (int step = 1; step <= 400; ++step) {
    const double travel = stride * (step <= 200 ? step : 400 - step) - 5e-3;
    const long before = allocations;
    const Frame& frame = simulation.step(travel);
    simulation.hand_stiffness();
    const long after = allocations;
    ASSERT_EQ(after, before) << "step " << step;
    ASSERT_EQ(frame.health, Health::good) << "step " << step;
    stages.insert(frame.stage);
  }
  EXPECT_TRUE(stages.contains(Stage::free));
  EXPECT_TRUE(stages.contains(Stage::contact) || stages.contains(Stage::buckled));
  EXPECT_TRUE(stages.contains(Stage::inserted));
  EXPECT_TRUE(stages.contains(Stage::withdrawn));
}

// Neither by the thread that steps nor by those that share the step.
TEST(SharedStepAllocation, is_none) {
  Scene scene;
  scene.tissue.tetrahedra = 17000;
  scene.tissue.relaxation_share = 0.4;
  scene.contact.rupture_force = 0.1;  // N
  for (const NeedleModel needle : {NeedleModel::column, NeedleModel::rod}) {
    scene.needle_model = needle;
    auto simulation = Simulation::build(scene, nullptr, 2);
    ASSERT_TRUE(simulation.ok()) << simulation.error().sentence;
    const long before = allocations_of_all;
    for (int step = 1; step <= 12; ++step) simulation->step(0.2e-3 * step);
    EXPECT_EQ(allocations_of_all, before);
    EXPECT_EQ(simulation->frame().health, Health::good);
  }
}

TEST(HandAllocation, is_none_while_a_person_pushes_hesitates_and_pulls_back) {
  HandScene scene;
  scene.kind = HandKind::person;
  scene.travel = 10e-3;
  scene.pulls_back = true;
  Hand hand(scene, 1e-3);
  double travel = 0.0, deepest = 0.0;
  const long before = allocations;
  while (const auto next = hand.next(200.0 * std::max(travel, 0.0)))
    deepest = std::max(deepest, travel = *next);
  EXPECT_EQ(allocations, before);
  EXPECT_GT(deepest, 9e-3);
}

}  // namespace
}  // namespace acus
