// The haptic loop with its threads: the device's, which ticks, and the simulation's. They share two mailboxes
// and nothing else; neither waits for the other.
#pragma once

#include <atomic>
#include <functional>

#include "acus/haptics/device.h"
#include "acus/haptics/hub_simulation.h"
#include "acus/haptics/loop_report.h"
#include "acus/haptics/recorder.h"

namespace acus::haptics {

inline constexpr const char* needle_thread = "acus-needle";  // as `top -H` and `htop` show it

// How the loop is doing, for whoever watches.
struct LoopStatus {
  double load = 0.0;  // of the last step: its time on the wall / its time step
  long late_ticks = 0;
  double tick_p999 = 0.0;     // s, of our part of a tick
  double device_force = 0.0;  // N
  GateState gate = GateState::disarmed;
  GateFault fault = GateFault::none;
};

// What may be asked of the loop while it runs, from any thread.
struct LoopControl {
  std::atomic<bool> armed{true};      // false: the force is let go; it comes back as at the start
  std::atomic<bool> paused{false};    // the simulation stands still, and the force is let go
  std::atomic<long> arm_requests{0};  // one more of them arms the gate again after a fault
};

struct LoopSettings {
  double force_limit = 0.0;  // N, the person's own; 0: the device's
  double start_travel =
      -5e-3;  // m, of the hand where the device is when it becomes ready; before first touch
  // Told of every fault of the gate, and of GateFault::none when it is armed again; from the simulation's
  // thread.
  std::function<void(GateFault)> announce;
  Recorder* recorder = nullptr;  // writes down every tick and every step; null: nobody does
  // Shown each step, and while there is none; from the simulation's thread, which it holds up.
  std::function<void(const Simulation&, const LoopStatus&)> watch;
  const LoopControl* control = nullptr;
};

struct LoopOutcome {
  LoopReport report;
  std::optional<Error> lost;  // how the device was lost, if it was
};

// Runs until `stop` is true and the force has fallen to nothing, or the device is lost. A button of the
// device arms the gate again after a fault. The scene of `simulation` is held_by() the device. The simulation
// runs at its own time step by the wall clock, or as fast as it can where it is slower than that, on a thread
// called needle_thread.
LoopOutcome run_loop(Device& device, Simulation& simulation, const LoopSettings& settings,
                     const std::atomic<bool>& stop);

}  // namespace acus::haptics
