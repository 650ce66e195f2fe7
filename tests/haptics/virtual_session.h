// A whole session in virtual time: a simulated device in a simulated hand, the servo as it is, and the
// simulation as slow as one likes. Nothing waits, nothing depends on the machine, so that hundreds can be run
// and each can be run again.
#pragma once

#include <algorithm>
#include <functional>
#include <random>

#include "acus/haptics/handle.h"
#include "acus/haptics/hub_simulation.h"
#include "acus/haptics/servo.h"

namespace acus::haptics {

// Where the hand wants to be, along the needle, as a function of time.
using HandPlan = std::function<double(double)>;

struct Trial {
  DeviceLimits device;
  HandModel hand;
  HandPlan plan;          // m from where the session starts
  Scene scene;            // its time step is the simulation's period
  double duration = 2.0;  // s
  double jitter = 0.0;    // of a tick, as a share of 1 ms
  std::function<bool(double)> stalled = [](double) { return false; };  // whether the simulation stands still
  unsigned seed = 1;
};

struct Finding {
  bool finite = true;
  double largest_force = 0.0;                     // N
  double largest_rise = 0.0, largest_fall = 0.0;  // N per tick
  double least_port_energy = 0.0;                 // J
  double top_speed = 0.0;                         // m/s, of the handle
  double limit_cycle = 0.0;                       // m, peak to peak over the last half second
  double last_force = 0.0;                        // N
  double largest_travel = 0.0;                    // m, of the hub
  GateFault fault = GateFault::none;
  GateInterventions interventions;
  Frame frame;  // the last
};

inline Finding run(const Trial& trial) {
  constexpr double tick = 1e-3;    // s
  constexpr double start = -5e-3;  // m, before first touch
  Result<Simulation> simulation = Simulation::build(trial.scene);
  HubSimulation needle(*simulation);
  Servo servo({trial.device, 0.0, start, tick});
  Handle handle(trial.device, trial.hand);
  std::mt19937 random(trial.seed);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  Finding found;
  LocalForce known, under_way;
  double next_word = 0.0;
  Vec3 before = Vec3::Zero(), encoder_before = handle.encoder();
  double lowest = 1e9, highest = -1e9;
  const Vec3 forward = trial.device.forward;
  for (long i = 0; i * tick < trial.duration; ++i) {
    const double now = handle.time();
    // The simulation works on what it read a period ago, and speaks when it is done.
    if (now >= next_word && !trial.stalled(now)) {
      known = under_way;
      under_way = needle.step(servo.hub_travel(), now + trial.scene.run.time_step);
      next_word = now + trial.scene.run.time_step;
    }
    DeviceState state;
    state.time = now;
    state.position = handle.encoder();
    state.velocity = (state.position - encoder_before) / tick;
    state.ready = true;
    encoder_before = state.position;
    const Wrench out = servo.tick(state, known);
    handle.command(out.force);
    const double rise = out.force.norm() - before.norm(), change = (out.force - before).norm();
    (rise > 0.0 ? found.largest_rise : found.largest_fall) =
        std::max(rise > 0.0 ? found.largest_rise : found.largest_fall, change);
    before = out.force;
    found.finite = found.finite && out.force.allFinite();
    found.largest_force = std::max(found.largest_force, out.force.norm());
    const double next = (static_cast<double>(i + 1) + 0.5 * trial.jitter * unit(random)) * tick;
    const double wanted = trial.plan(now), later = trial.plan(next);
    handle.advance_to(next, {forward * later, forward * ((later - wanted) / (next - now))});
    found.least_port_energy = std::min(found.least_port_energy, handle.port_energy());
    found.top_speed = std::max(found.top_speed, handle.velocity().norm());
    found.largest_travel = std::max(found.largest_travel, servo.hub_travel());
    if (now > trial.duration - 0.5) {
      lowest = std::min(lowest, forward.dot(handle.position()));
      highest = std::max(highest, forward.dot(handle.position()));
    }
  }
  found.limit_cycle = highest - lowest;
  found.last_force = before.norm();
  found.fault = servo.gate().fault();
  found.interventions = servo.gate().interventions();
  found.frame = simulation->frame();
  return found;
}

}  // namespace acus::haptics
