// The loop with its threads and the wall clock: a simulated hand pushes a bare column until it buckles.
#include "acus/haptics/haptic_loop.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <initializer_list>
#include <thread>
#include <vector>

#include "acus/haptics/simulated_device.h"
#include "acus/haptics/stop_after.h"
#include "acus/haptics/virtual_coupling.h"
#include "acus/needle/buckling.h"
#include "watched_device.h"

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
  Result<Simulation> simulation = Simulation::build(held_by(*find_device_limits("touch"), scene));
  const LoopOutcome outcome = run_for(2.5, *simulation);
  const LoopReport& report = outcome.report;
  EXPECT_FALSE(outcome.lost);
  EXPECT_GT(report.period.count(), 100);
  EXPECT_GT(report.step.count(), 100);
  EXPECT_EQ(report.health, Health::good);
  if (report.fault != GateFault::none) {
    // Whoever shares the processor stalled the loop: was the gate right?
    EXPECT_EQ(report.fault, GateFault::stale);
    EXPECT_GT(report.age.longest(), 0.045);
    EXPECT_LT(report.age.quantile(0.9), 0.02);  // the simulation went on to speak
    return;
  }
  const double critical =
      needle::critical_load(needle::bending_rigidity(scene.needle), 0.2, scene.needle.support);
  EXPECT_NEAR(simulation->frame().hand_force, critical, 0.1 * critical);
  // Until the simulation speaks again the hub stands still, and the hand at 40 mm/s stretches the coupling.
  const double while_waiting =
      coupling_for(*find_device_limits("touch"), 1e-3).stiffness * 40e-3 * report.age.longest();
  EXPECT_GT(report.largest_force, 0.9 * critical);
  EXPECT_LT(report.largest_force, 1.15 * critical + while_waiting);
  EXPECT_FALSE(simulation->events().empty());
}

// Whoever shares the processor may stall a loop until the gate takes the force, before the test has begun.
constexpr int tries = 10;

// Whoever watches sees each step, may take the force away and give it back, and may halt the needle's time.
TEST(HapticLoop, lets_go_and_stands_still_when_it_is_asked_to) {
  enum { pushing, letting_go, without, standing, done } phase = pushing;
  double force_before = 0.0;
  for (int i = 0; i < tries && phase == pushing; ++i) {
    Result<Simulation> simulation =
        Simulation::build(held_by(*find_device_limits("touch"), testing_machine()));
    SimulatedDevice device(*find_device_limits("touch"), light_grip,
                           [](double t) { return std::clamp(40e-3 * (t - 0.8), 0.0, 40e-3); });
    LoopControl control;
    LoopSettings settings;
    settings.control = &control;
    std::atomic<bool> stop{false};
    long looks = 0;
    double time_before = 0.0, stood_at = 0.0;
    settings.watch = [&](const Simulation& now, const LoopStatus& status) {
      ++looks;
      if (phase == pushing && status.device_force > 0.4) {
        phase = letting_go;
        looks = 0;
        control.armed = false;
      } else if (phase == pushing && status.fault != GateFault::none) {
        stop = true;
      } else if (phase == letting_go && status.device_force == 0.0) {
        phase = without;
        EXPECT_LT(looks, 300);  // and not for another reason, later
        time_before = now.frame().time;
      } else if (phase == without) {
        EXPECT_EQ(status.device_force, 0.0);
        EXPECT_NE(status.gate, GateState::armed);
        force_before = std::max(force_before, now.frame().hand_force);
        if (now.frame().time > time_before + 0.2) {
          phase = standing;
          control.paused = true;
          stood_at = now.frame().time;
          looks = 0;
        }
      } else if (phase == standing) {
        EXPECT_EQ(now.frame().time, stood_at);
        if (looks > 100) {
          phase = done;
          stop = true;
        }
      }
    };
    const StopAfter safety(30.0, stop);
    run_loop(device, *simulation, settings, safety.flag());
  }
  EXPECT_EQ(phase, done);
  EXPECT_GT(force_before, 0.3);  // the needle went on to push; only the device let go
}

// A simulation that was silent for too long leaves a fault, until somebody asks to arm the gate again.
TEST(HapticLoop, is_armed_again_when_whoever_watches_asks_for_it) {
  Result<Simulation> simulation = Simulation::build(held_by(*find_device_limits("touch"), testing_machine()));
  SimulatedDevice device(*find_device_limits("touch"), light_grip, [](double) { return 0.0; });
  LoopControl control;
  LoopSettings settings;
  settings.control = &control;
  std::atomic<bool> stop{false};
  enum { beginning, silent, asked, armed } phase = beginning;
  long faulty_looks = 0;
  settings.watch = [&](const Simulation&, const LoopStatus& status) {
    if (phase == beginning && status.gate == GateState::armed) {
      std::this_thread::sleep_for(std::chrono::milliseconds(150));
      phase = silent;
    } else if (phase == silent && status.fault == GateFault::stale && ++faulty_looks > 50) {
      ++control.arm_requests;
      phase = asked;
    } else if (phase == asked && status.fault == GateFault::none) {
      phase = armed;
      stop = true;
    }
  };
  const StopAfter safety(60.0, stop);
  run_loop(device, *simulation, settings, safety.flag());
  EXPECT_EQ(phase, armed);
}

// A simulation that ends with a failed step falls silent, and the loop goes on without force.
TEST(HapticLoop, goes_on_without_force_when_the_simulation_fails) {
  Scene scene = testing_machine();
  Result<Simulation> simulation = Simulation::build(held_by(*find_device_limits("touch"), scene));
  simulation->step(std::nan(""));
  const LoopOutcome outcome = run_for(0.3, *simulation);
  EXPECT_EQ(outcome.report.health, Health::not_finite);
  EXPECT_EQ(outcome.report.largest_force, 0.0);
  EXPECT_GT(outcome.report.period.count(), 10);
}

// A device whose handle rests, in ticks of its own: one word of its speed is no number in the ticks of
// `broken`, and its button is down from `down` to `up`.
class Broken final : public Device {
 public:
  Broken(std::initializer_list<int> broken, int down, int up) : broken_(broken), down_(down), up_(up) {}
  const DeviceLimits& limits() const override { return *find_device_limits("touch"); }
  std::optional<Error> serve(Tick& tick, const std::atomic<bool>&) override {
    DeviceState state;
    state.ready = true;
    for (int i = 0; i < 100; ++i) {
      const bool now = std::find(broken_.begin(), broken_.end(), i) != broken_.end();
      state.time = i * 1e-3;
      state.velocity.x() = now ? std::nan("") : 0.0;
      state.buttons = i >= down_ && i < up_ ? 1U : 0U;
      tick(state);
    }
    return std::nullopt;
  }

 private:
  std::vector<int> broken_;
  int down_, up_;
};

// A machine with much else to do may let the command grow stale: that is not the device's fault, and tried
// again.
GateFault fault_after(const Broken& broken) {
  GateFault fault = GateFault::stale;
  for (int i = 0; i < tries && fault == GateFault::stale; ++i) {
    Broken device = broken;
    Result<Simulation> simulation =
        Simulation::build(held_by(*find_device_limits("touch"), testing_machine()));
    const std::atomic<bool> never{false};
    fault = run_loop(device, *simulation, {}, never).report.fault;
  }
  return fault;
}

TEST(HapticLoop, keeps_a_fault_until_a_button_is_pressed) {
  EXPECT_EQ(fault_after(Broken({10}, 0, 0)), GateFault::not_finite);
  EXPECT_EQ(fault_after(Broken({10}, 50, 60)), GateFault::none);
  EXPECT_EQ(fault_after(Broken({10, 70}, 50, 60)), GateFault::not_finite);
}

TEST(HapticLoop, takes_a_button_that_stays_down_for_no_other_press) {
  EXPECT_EQ(fault_after(Broken({10, 70}, 50, 100)), GateFault::not_finite);
}

// Told to stop while the needle pushes: the device is served until there is no force any more.
TEST(HapticLoop, ends_by_the_slew_and_not_before_the_force_is_gone) {
  double largest = 0.0, before = 0.0, last = 0.0, largest_fall = 0.0;
  int ticks_to_zero = 0;
  for (int i = 0; i < tries && largest < 1.5; ++i) {
    Scene stiffer = testing_machine();
    stiffer.needle.length = 0.1;
    Result<Simulation> simulation = Simulation::build(held_by(*find_device_limits("touch"), stiffer));
    SimulatedDevice hand(*find_device_limits("touch"), light_grip,
                         [](double t) { return std::clamp(0.1 * t, 0.0, 60e-3); });
    std::atomic<bool> stop{false};
    int ticks = 0;
    ticks_to_zero = 0;
    WatchedDevice device(hand, [&](const DeviceState&, const Wrench& out) {
      last = out.force.norm();
      largest_fall = std::max(largest_fall, before - last);
      before = last;
      ticks_to_zero += stop;
      stop = stop || last > 1.5 || ++ticks > 2000;
    });
    largest = run_loop(device, *simulation, {}, stop).report.largest_force;
  }
  EXPECT_GT(largest, 1.5);
  EXPECT_EQ(last, 0.0);
  EXPECT_LE(largest_fall, 1.0 + 1e-12);
  EXPECT_LE(ticks_to_zero, 3);  // a newton each
}

}  // namespace
}  // namespace acus::haptics
