// The last thing before a device. Whatever is asked for, what leaves here is finite, no stronger than the
// device and the person allow, and changes no faster than a hand can follow; and it is nothing at all until
// somebody has armed it and the command has been quiet. Depends on nothing but the standard library, so that
// it can be read, tested and trusted alone.
//
// What each guard does, per tick:
// - not finite: a command, velocity, age or clock that is no number: force off, latched;
// - stale: older than 20 ms: the last force is held and damped; older than 50 ms: ramped down, latched, 0 N
//   before 100 ms;
// - over-speed: the handle is faster than 1.2 m/s: force off, latched;
// - overheated: the mean force of 10 s is above what the device may show for long: ramped down over 1 s,
// latched;
//   (before any force is on, only what is no number latches: the others just keep it off)
// - arming: force only after 4 ticks of less than 0.2 N, then growing from nothing over 0.5 s;
// - ceiling: the force, fresh or held, goes no higher than this tick allows (passivity_layer.h), and falls to
// that by the
//   slew;
// - slew: rises by at most 0.5 N/ms, falls by at most 1 N/ms;
// - peak: norm of the force at most peak_force; last of all.
// "Off" falls by the slew too: a blow to zero is a blow.
#pragma once

#include <array>
#include <cstddef>

namespace acus::haptics {

struct GateLimits {
  double peak_force = 0.0;        // N, the smaller of the device's and the person's
  double continuous_force = 0.0;  // N, on the mean of 10 s
  double peak_torque = 0.0;       // N m; torques change as fast in proportion to their peak as forces do
};

struct GateCommand {
  std::array<double, 3> force{};     // N
  std::array<double, 3> torque{};    // N m
  std::array<double, 3> velocity{};  // m/s, of the handle
  double age = 0.0;                  // s, since the simulation last spoke
  double elapsed = 0.0;              // s, since the last tick
  double ceiling = 1e6;              // N, for this tick alone
};

struct GateOutput {
  std::array<double, 3> force{};   // N
  std::array<double, 3> torque{};  // N m
};

enum class GateState { disarmed, ramping, armed };
enum class GateFault { none, not_finite, stale, over_speed, overheated };

// In how many ticks each guard had something to say.
struct GateInterventions {
  std::array<long, 5> faults{};  // by GateFault
  long held = 0;                 // the command was too old to be followed
  long disarmed = 0;             // all or part of a fresh command was held back until the force is armed
  long ceiling = 0, slew = 0, peak = 0;
};

// s: of an older command the last one is held.
inline constexpr double followed_age = 20e-3;

class ForceGate {
 public:
  // Numbers of `limits` that are negative or no numbers count as zero: then no force leaves.
  explicit ForceGate(const GateLimits& limits) noexcept;

  // One tick. Allocates nothing, throws nothing.
  GateOutput pass(const GateCommand& command) noexcept;

  // Lets a latched fault go; the force then comes back as at the start. Does nothing without a fault.
  void rearm() noexcept;

  GateState state() const noexcept { return state_; }
  GateFault fault() const noexcept { return fault_; }  // the first since the last rearm()
  const GateInterventions& interventions() const noexcept { return interventions_; }

 private:
  GateFault complaint(const GateCommand& command) const noexcept;
  void latch(GateFault wrong) noexcept;
  void arm(const GateOutput& wanted, GateFault wrong, double elapsed) noexcept;
  void move_towards(const GateOutput& wanted, double ceiling, double elapsed) noexcept;
  void remember(double elapsed) noexcept;

  static constexpr std::size_t windows = 100;  // of 0.1 s

  GateLimits limits_;
  double torque_share_;  // m, of a peak torque to a peak force
  GateState state_ = GateState::disarmed;
  GateFault fault_ = GateFault::none;
  int quiet_ticks_ = 0;
  double share_ = 0.0;                     // of the command that is let through
  double fade_time_ = 0.0;                 // s, in which a fault takes the share from 1 to 0
  GateOutput held_;                        // the last command that was fresh
  GateOutput last_;                        // what left in the last tick
  std::array<double, windows> impulse_{};  // N s, of the last 10 s in windows of 0.1 s
  std::size_t window_ = 0;                 // the one that is being filled
  double window_age_ = 0.0;                // s
  double impulse_sum_ = 0.0;               // N s, of them all
  GateInterventions interventions_;
};

}  // namespace acus::haptics
