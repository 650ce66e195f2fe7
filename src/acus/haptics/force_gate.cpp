#include "acus/haptics/force_gate.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace acus::haptics {
namespace {

using Triple = std::array<double, 3>;

constexpr double tick = 1e-3;          // s, the longest for which one tick lets a force rise or fall
constexpr double longest_tick = 0.1;   // s, that is believed
constexpr double rise = 500.0;         // N/s
constexpr double fall = 1000.0;        // N/s
constexpr double quiet_force = 0.2;    // N
constexpr int quiet_needed = 4;        // ticks
constexpr double arming_time = 0.5;    // s
constexpr double hold_damping = 1.0;   // N s/m
constexpr double stale_after = 50e-3;  // s, of age
constexpr double top_speed = 1.2;      // m/s
// s, in which a GateFault takes the force away: none, not_finite, stale (with time to spare before 100 ms),
// over_speed, overheated.
constexpr std::array fade_times{0.0, 0.0, 45e-3, 0.0, 1.0};
constexpr double noticed = 1e-3;     // N: rounding about nothing is no intervention
constexpr double window_time = 0.1;  // s
constexpr double mean_time = 10.0;   // s
constexpr double most = 1e6;         // N, N m or m/s: nothing here is larger, and its norm is a number

bool finite(const Triple& v) noexcept {
  return std::isfinite(v[0]) && std::isfinite(v[1]) && std::isfinite(v[2]);
}

Triple bounded(const Triple& v) noexcept {
  return {std::clamp(v[0], -most, most), std::clamp(v[1], -most, most), std::clamp(v[2], -most, most)};
}

double norm(const Triple& v) noexcept { return std::hypot(v[0], v[1], v[2]); }

Triple sum(const Triple& a, const Triple& b, double factor) noexcept {  // a + factor b
  return {a[0] + factor * b[0], a[1] + factor * b[1], a[2] + factor * b[2]};
}

Triple scaled(const Triple& v, double factor) noexcept {
  return {factor * v[0], factor * v[1], factor * v[2]};
}

Triple clamped(const Triple& v, double peak) noexcept {
  const double size = norm(v);
  return size > peak ? scaled(v, peak / size) : v;
}

// From `last` towards `wanted` by at most the slew of `elapsed`; `unit` newtons make one unit of the
// quantity.
Triple slewed(const Triple& last, const Triple& wanted, double elapsed, double unit) noexcept {
  const double rate = norm(wanted) > norm(last) ? rise : fall;
  return sum(last, clamped(sum(wanted, last, -1.0), rate * unit * elapsed), 1.0);
}

double positive(double limit) noexcept { return std::isfinite(limit) ? std::max(limit, 0.0) : 0.0; }

}  // namespace

ForceGate::ForceGate(const GateLimits& limits) noexcept
    : limits_{positive(limits.peak_force), positive(limits.continuous_force), positive(limits.peak_torque)},
      torque_share_(limits_.peak_force > 0.0 ? limits_.peak_torque / limits_.peak_force : 0.0) {}

GateOutput ForceGate::pass(const GateCommand& command) noexcept {
  const GateFault wrong = complaint(command);
  const bool sound = wrong != GateFault::not_finite;
  const double elapsed = sound ? std::clamp(command.elapsed, 0.0, longest_tick) : tick;
  const double counted = std::min(elapsed, tick);
  if (wrong != GateFault::none) latch(wrong);

  GateOutput wanted;
  if (sound && command.age <= followed_age) {
    wanted = held_ = {bounded(command.force), bounded(command.torque)};
    arm(wanted, wrong, counted);
  } else if (sound) {
    wanted = {sum(held_.force, bounded(command.velocity), -hold_damping), held_.torque};
    quiet_ticks_ = 0;
    ++interventions_.held;
  }
  if (fault_ != GateFault::none)
    share_ = fade_time_ > 0.0 ? std::max(share_ - elapsed / fade_time_, 0.0) : 0.0;
  move_towards({scaled(wanted.force, share_), scaled(wanted.torque, share_)}, command.ceiling, counted);
  remember(elapsed);
  return last_;
}

void ForceGate::rearm() noexcept {
  if (fault_ == GateFault::none) return;
  fault_ = GateFault::none;
  quiet_ticks_ = 0;
  share_ = 0.0;
  held_ = {};
}

// What is wrong now, the worst first.
GateFault ForceGate::complaint(const GateCommand& command) const noexcept {
  if (!finite(command.force) || !finite(command.torque) || !finite(command.velocity) ||
      !std::isfinite(command.age) || !std::isfinite(command.elapsed) || std::isnan(command.ceiling))
    return GateFault::not_finite;
  if (norm(bounded(command.velocity)) > top_speed) return GateFault::over_speed;
  if (command.age > stale_after) return GateFault::stale;
  if (impulse_sum_ > limits_.continuous_force * mean_time) return GateFault::overheated;
  return GateFault::none;
}

// Before any force is on there is nothing to take away: then only what is no number latches. The first fault
// is the one that is told; a later one that must act faster does.
void ForceGate::latch(GateFault wrong) noexcept {
  interventions_.faults[static_cast<std::size_t>(wrong)]++;
  if (wrong != GateFault::not_finite && state_ == GateState::disarmed && fault_ == GateFault::none) return;
  const double time = fade_times[static_cast<std::size_t>(wrong)];
  fade_time_ = fault_ == GateFault::none ? time : std::min(fade_time_, time);
  if (fault_ == GateFault::none) fault_ = wrong;
  state_ = GateState::disarmed;
}

// After enough quiet ticks the share grows from nothing.
void ForceGate::arm(const GateOutput& wanted, GateFault wrong, double elapsed) noexcept {
  if (fault_ != GateFault::none || state_ == GateState::armed) return;
  if (state_ == GateState::ramping) {
    share_ = std::min(share_ + elapsed / arming_time, 1.0);
    if (share_ == 1.0) state_ = GateState::armed;
    ++interventions_.disarmed;
    return;
  }
  ++interventions_.disarmed;
  const bool quiet = wrong == GateFault::none && norm(wanted.force) < quiet_force &&
                     norm(wanted.torque) <= quiet_force * torque_share_;
  quiet_ticks_ = quiet ? quiet_ticks_ + 1 : 0;
  if (quiet_ticks_ >= quiet_needed) state_ = GateState::ramping;
}

void ForceGate::move_towards(const GateOutput& wanted, double ceiling, double elapsed) noexcept {
  const Triple allowed = clamped(wanted.force, std::max(ceiling, 0.0));
  interventions_.ceiling += norm(wanted.force) > norm(allowed) + noticed;
  const GateOutput aim{clamped(allowed, limits_.peak_force), clamped(wanted.torque, limits_.peak_torque)};
  interventions_.peak += aim.force != allowed || aim.torque != wanted.torque;
  const GateOutput next{slewed(last_.force, aim.force, elapsed, 1.0),
                        slewed(last_.torque, aim.torque, elapsed, torque_share_)};
  interventions_.slew += next.force != aim.force || next.torque != aim.torque;
  last_ = {clamped(next.force, limits_.peak_force), clamped(next.torque, limits_.peak_torque)};
}

// Books what left, for the mean of the last 10 s.
void ForceGate::remember(double elapsed) noexcept {
  const double impulse = norm(last_.force) * elapsed;
  impulse_[window_] += impulse;
  impulse_sum_ += impulse;
  window_age_ += elapsed;
  if (window_age_ < window_time) return;
  window_age_ = 0.0;
  window_ = (window_ + 1) % windows;
  impulse_sum_ -= impulse_[window_];
  impulse_[window_] = 0.0;
}

}  // namespace acus::haptics
