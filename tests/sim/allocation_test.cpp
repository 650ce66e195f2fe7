// A step allocates nothing, whatever happens in it. This program counts every operator new.
#include <gtest/gtest.h>

#include <set>

#include "acus/sim/simulation.h"
#include "tests/counted_allocations.h"

namespace acus {
namespace {

class StepAllocation : public ::testing::TestWithParam<std::pair<Element, Coupling>> {};
INSTANTIATE_TEST_SUITE_P(, StepAllocation,
                         ::testing::Values(std::pair{Element::nodal_pressure, Coupling::embedded},
                                           std::pair{Element::linear, Coupling::embedded},
                                           std::pair{Element::linear, Coupling::nearest_node}));

// In and out again in 400 steps: contact, puncture, cutting, withdrawal.
TEST_P(StepAllocation, is_none_through_contact_puncture_and_withdrawal) {
  Scene scene;
  scene.tissue.tetrahedra = 600;
  scene.tissue.element = GetParam().first;
  scene.contact.coupling = GetParam().second;
  scene.contact.rupture_force = 0.5;  // N
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

}  // namespace
}  // namespace acus
