// The loop with its threads and the wall clock: a simulated hand pushes a bare column until it buckles.
#include "acus/haptics/haptic_loop.h"

#include <gtest/gtest.h>

#include "acus/haptics/simulated_device.h"
#include "acus/haptics/stop_after.h"
#include "acus/needle/buckling.h"

namespace acus::haptics {
namespace {

Scene testing_machine() {
  Scene scene;
  scene.tissue.rigid = true;
  scene.needle.length = 0.2;
  return scene;
}

// For so long [s], with a hand that wants to push 40 mm far at 40 mm/s.
LoopOutcome run_for(double duration, Simulation& simulation) {
  SimulatedDevice device(*find_device_limits("touch"), light_grip,
                         [](double t) { return std::clamp(40e-3 * (t - 0.8), 0.0, 40e-3); });
  const std::atomic<bool> never{false};
  const StopAfter stop(duration, never);
  return run_loop(device, simulation, {}, stop.flag());
}

TEST(HapticLoop, lets_the_hand_feel_the_needle_buckle) {
  const Scene scene = testing_machine();
  // Whoever shares the processor may stall the loop, and the gate then rightly takes the force away: again,
  // then.
  for (int attempt = 0; attempt < 5; ++attempt) {
    Result<Simulation> simulation = Simulation::build(scene);
    const LoopOutcome outcome = run_for(2.5, *simulation);
    EXPECT_FALSE(outcome.lost);
    EXPECT_GT(outcome.report.period.count(), 100);
    EXPECT_GT(outcome.report.step.count(), 100);
    EXPECT_EQ(outcome.report.health, Health::good);
    EXPECT_LE(outcome.report.largest_force, find_device_limits("touch")->peak_force);
    if (outcome.report.fault != GateFault::none) continue;
    const double critical =
        needle::critical_load(needle::bending_rigidity(scene.needle), 0.2, scene.needle.support);
    EXPECT_NEAR(simulation->frame().hand_force, critical, 0.1 * critical);
    // The largest of all ticks has the swing of the first contact in it, which grows with every tick that
    // comes late.
    EXPECT_GT(outcome.report.largest_force, 0.9 * critical);
    EXPECT_LT(outcome.report.largest_force, 1.5 * critical);
    EXPECT_FALSE(simulation->events().empty());
    return;
  }
  GTEST_SKIP() << "this machine stalls too often for a loop in real time";
}

// A simulation that ends with a failed step falls silent, and the loop goes on without force.
TEST(HapticLoop, goes_on_without_force_when_the_simulation_fails) {
  Scene scene = testing_machine();
  Result<Simulation> simulation = Simulation::build(scene);
  simulation->step(std::nan(""));
  const LoopOutcome outcome = run_for(0.3, *simulation);
  EXPECT_EQ(outcome.report.health, Health::not_finite);
  EXPECT_EQ(outcome.report.largest_force, 0.0);
  EXPECT_GT(outcome.report.period.count(), 10);
}

}  // namespace
}  // namespace acus::haptics
