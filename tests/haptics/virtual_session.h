// A whole session in virtual time: a simulated device in a simulated hand, the servo as it is, and the
// simulation as slow as one likes. Nothing waits, nothing depends on the machine, so that hundreds can be run
// and each can be run again.
#pragma once

#include <algorithm>
#include <functional>
#include <limits>
#include <optional>
#include <random>

#include "acus/haptics/handle.h"
#include "acus/haptics/hub_simulation.h"
#include "acus/haptics/servo.h"

namespace acus::haptics {

// Where the hand wants to be, along the needle, as a function of time.
using HandPlan = std::function<double(double)>;

inline constexpr double never = std::numeric_limits<double>::infinity();

struct Trial {
  DeviceLimits device;
  HandModel hand;
  HandPlan plan;  // m from where the session starts
  Scene scene;
  double period = 0.0;           // s, from one word of the simulation to the next; 0: its time step
  double duration = 2.0;         // s
  double jitter = 0.0;           // of a tick, as a share of 1 ms
  double stalls = never;         // s, when the simulation stands still,
  double stall_time = never;     // s, for so long
  double lets_go = never;        // s, when the hand does
  double unplugged = never;      // s, when the device is, for 0.3 s
  double reload = never;         // s, when another scene takes the place of this one
  std::optional<Scene> another;  // and which
  unsigned seed = 1;
};

struct Finding {
  bool finite = true;
  double largest_force = 0.0;                     // N
  double largest_rise = 0.0, largest_fall = 0.0;  // N per tick
  double least_port_energy = 0.0;                 // J
  double top_speed = 0.0;                         // m/s, of the handle
  double limit_cycle = 0.0;                       // m, to and fro in the last half second, if it lasts
  double last_force = 0.0;                        // N, mean of the last tenth of a second
  double largest_travel = 0.0;                    // m, of the hub
  double longest_force_after_stall = 0.0;         // s
  GateFault fault = GateFault::none;              // at the end
  bool faulted = false;                           // ever
  GateInterventions interventions;
  bool touched = false, buckled = false, punctured = false;
  Frame frame;  // the last
};

// How far something goes to and fro; a drift in one direction is no swing.
class Swing {
 public:
  void add(double x) {
    high_ = std::max(high_, x);
    low_ = std::min(low_, x);
    fall_ = std::max(fall_, high_ - x);
    rise_ = std::max(rise_, x - low_);
  }
  double size() const { return std::min(fall_, rise_); }

 private:
  double high_ = -never, low_ = never, fall_ = 0.0, rise_ = 0.0;
};

inline Finding run(const Trial& trial) {
  constexpr double tick = 1e-3;    // s
  constexpr double start = -5e-3;  // m, before first touch
  constexpr double late = 0.5;     // s, in which a swing is looked for,
  constexpr double early = 1.0;    // s, before that: longer than a hand's own swing takes
  const double period = trial.period > 0.0 ? trial.period : trial.scene.run.time_step;
  Result<Simulation> simulation = Simulation::build(held_by(trial.device, trial.scene));
  std::optional<HubSimulation> needle(std::in_place, *simulation);
  Servo servo({trial.device, 0.0, start, tick});
  Handle handle(trial.device, trial.hand);
  std::mt19937 random(trial.seed);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  Finding found;
  LocalForce known, under_way;
  double next_word = 0.0, faulty_since = never;
  Vec3 before = Vec3::Zero(), encoder_before = handle.encoder();
  Swing early_swing, swing;
  double force_sum = 0.0;
  long force_count = 0;
  bool held = true, reloaded = false;
  const Vec3 forward = trial.device.forward;
  for (long i = 0; i * tick < trial.duration; ++i) {
    const double now = handle.time();
    if (now >= trial.reload && !reloaded) {
      simulation = Simulation::build(held_by(trial.device, *trial.another));
      needle.emplace(*simulation);
      reloaded = true;
    }
    if (now >= trial.lets_go && held) {
      handle.change_hand(no_hand);
      held = false;
    }
    // The simulation works on what it read a period ago, and speaks when it is done.
    const bool stalled = now >= trial.stalls && now < trial.stalls + trial.stall_time;
    if (now >= next_word && !stalled) {
      known = under_way;
      under_way = needle->step(servo.hand(), now + period);
      next_word = now + period;
    }
    DeviceState state;
    state.time = now;
    state.position = handle.encoder();
    state.velocity = (state.position - encoder_before) / tick;
    state.ready = !(now >= trial.unplugged && now < trial.unplugged + 0.3);
    encoder_before = state.position;
    Wrench out = servo.tick(state, known);
    if (!state.ready) out = {};  // nothing reaches a device that is not there
    handle.command(out.force);
    found.faulted = found.faulted || servo.gate().fault() != GateFault::none;
    if (servo.gate().fault() == GateFault::none) faulty_since = never;
    // Somebody who sees that the force is off turns it on again.
    if (servo.gate().fault() != GateFault::none && faulty_since == never) faulty_since = now;
    if (state.ready && now > faulty_since + 0.5) servo.rearm();
    if (stalled && out.force.norm() > 0.0)
      found.longest_force_after_stall = std::max(found.longest_force_after_stall, now - trial.stalls);
    const bool continuous = state.ready && !(now >= trial.unplugged && now < trial.unplugged + 0.31);
    const double rise = out.force.norm() - before.norm(), change = (out.force - before).norm();
    if (continuous) {
      double& largest = rise > 0.0 ? found.largest_rise : found.largest_fall;
      largest = std::max(largest, change);
    }
    before = out.force;
    found.finite = found.finite && out.force.allFinite();
    found.largest_force = std::max(found.largest_force, out.force.norm());
    const double next = (static_cast<double>(i + 1) + 0.5 * trial.jitter * unit(random)) * tick;
    const double wanted = trial.plan(now), later = trial.plan(next);
    handle.advance_to(next, {forward * later, forward * ((later - wanted) / (next - now))});
    found.least_port_energy = std::min(found.least_port_energy, handle.port_energy());
    found.top_speed = std::max(found.top_speed, handle.velocity().norm());
    found.largest_travel = std::max(found.largest_travel, simulation->frame().hand_travel);
    if (now > trial.duration - late)
      swing.add(forward.dot(handle.position()));
    else if (now > trial.duration - late - early)
      early_swing.add(forward.dot(handle.position()));
    if (now > trial.duration - 0.1) force_sum += out.force.norm(), ++force_count;
  }
  // A hand's own swing dies away; one that is fed does not.
  found.limit_cycle = swing.size() < 0.5 * early_swing.size() ? 0.0 : swing.size();
  found.last_force = force_count > 0 ? force_sum / static_cast<double>(force_count) : 0.0;
  found.fault = servo.gate().fault();
  found.interventions = servo.gate().interventions();
  found.frame = simulation->frame();
  for (const Event& event : simulation->events()) {
    found.touched |= event.kind == EventKind::contact;
    found.buckled |= event.kind == EventKind::buckling;
    found.punctured |= event.kind == EventKind::puncture;
  }
  return found;
}

}  // namespace acus::haptics
