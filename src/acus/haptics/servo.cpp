#include "acus/haptics/servo.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace acus::haptics {
namespace {

double person_and_device(double person, double device) {
  return person > 0.0 ? std::min(person, device) : device;
}

std::array<double, 3> three(const Vec3& v) { return {v.x(), v.y(), v.z()}; }

}  // namespace

Servo::Servo(const ServoSettings& settings)
    : coupling_(coupling_for(settings.limits, settings.period)),
      gate_({person_and_device(settings.force_limit, settings.limits.peak_force),
             settings.limits.continuous_force, settings.limits.peak_torque}),
      passivity_(settings.limits, coupling_.stiffness, settings.period),
      hold_damper_(settings.period),
      period_(settings.period),
      forward_(settings.limits.forward),
      start_travel_(settings.start_travel),
      hand_travel_(settings.start_travel) {}

// A new word of the simulation says something else about the place where the hand is now. The difference
// fades over a few milliseconds, unless the needle has really jumped.
LocalForce Servo::blended(LocalForce local, double now) noexcept {
  local.stiffness = std::clamp(local.stiffness, 0.0, coupling_.stiffness);  // the grip's, or less
  if (local.time != known_.time) {
    constexpr double longest = 5e-3;  // s: later is too late
    const double left = blend_time_ > 0.0 ? std::max(1.0 - (now - blend_from_) / blend_time_, 0.0) : 0.0;
    const bool follows = known_.time >= 0.0 && local.events == known_.events;
    offset_ = follows ? left * offset_ + force_at(known_, hand_travel_) - force_at(local, hand_travel_) : 0.0;
    if (!std::isfinite(offset_)) offset_ = 0.0;  // one bad word must not spoil those after it
    blend_from_ = now;
    blend_time_ = follows ? std::clamp(local.time - known_.time, 0.0, longest) : 0.0;
    hold_damper_.word(known_.time >= 0.0 ? local.time - known_.time : 0.0);
    known_ = local;
    passivity_.compare(local.hand.work, local.hand.felt, local.taken, local.stored);
  }
  if (blend_time_ > 0.0) local.force += offset_ * std::max(1.0 - (now - blend_from_) / blend_time_, 0.0);
  return local;
}

// Where the device first becomes ready, and again after it was not: the needle stays where it was, and the
// force comes as at the start.
void Servo::place(const DeviceState& device) noexcept {
  if (!device.ready) placed_ = false;
  if (!device.ready || placed_ || !device.position.allFinite()) return;
  origin_ = position_ = device.position;
  way_.setZero();
  start_travel_ = hand_travel_;
  placed_ = true;
  gate_.rearm();
}

Wrench Servo::tick(const DeviceState& device, const LocalForce& local) noexcept {
  constexpr double never = 1.0;  // s: older than any age that is followed
  place(device);
  const bool speaks = placed_ && local.time >= 0.0;
  const double age = speaks ? std::max(device.time - local.time, 0.0) : never;
  const Vec3 step = device.position - position_;
  const double shown = -forward_.dot(shown_);
  passivity_.moved(placed_ ? forward_.dot(step) : 0.0, shown - answered_, hold_damper_.holds());
  answered_ = 0.0;
  // A device that jumps is no hand that moves: the needle stays where it is, and the gate sees the speed.
  const bool jumps = placed_ && step.allFinite() && step.norm() > longest_step;
  const Vec3 velocity = jumps ? Vec3(step / period_) : device.velocity;
  position_ = device.position;
  if (jumps) origin_ = device.position - way_;

  Vec3 force = Vec3::Zero();
  double ceiling = passivity_.soft_ceiling(shown);
  if (speaks) {
    const Vec3 way = jumps ? way_ : Vec3(device.position - origin_);
    const double along = forward_.dot(way);
    if (way.allFinite()) {  // else the gate turns the force off
      way_ = way;
      hand_travel_ = start_travel_ + along;
    }
    const double needle = force_at(blended(local, device.time), start_travel_ + along);
    const bool followed = age <= followed_age && gate_.state() == GateState::armed;
    passivity_.felt(start_travel_ + along, followed ? needle : shown);
    const double drag = coupling_.damping * forward_.dot(device.velocity);
    const double felt =
        felt_along(needle, drag, jumps ? 0.0 : forward_.dot(step), forward_.dot(velocity), age);
    // The hub stays on the axis of insertion: across it the coupling holds the hand there.
    force = -felt * forward_ - coupling_.stiffness * (way - along * forward_) -
            coupling_.damping * (device.velocity - forward_.dot(device.velocity) * forward_);
    if (age <= followed_age) ceiling = std::numeric_limits<double>::infinity();
  }
  if (let_go_) force.setZero();
  const GateOutput out = gate_.pass({three(force),
                                     {},
                                     three(velocity),
                                     let_go_ ? 0.0 : age,
                                     device.time - last_tick_,
                                     ceiling + across(shown_)});
  last_tick_ = device.time;
  shown_ = Vec3(out.force.data());
  if (!shown_.isApprox(force)) answered_ = 0.0;
  return {shown_, Vec3(out.torque.data())};
}

// The needle's force as far as the tank backs it, and what damps.
double Servo::felt_along(double needle, double drag, double step, double speed, double age) noexcept {
  constexpr double noticed = 1e-3;  // N
  // What the gate may hold is the needle's force alone: an answer to the speed of one tick is wrong in the
  // next.
  const bool may_be_held = age + 2.0 * period_ > followed_age;
  const bool followed = age <= followed_age && gate_.state() == GateState::armed;
  const double backing = passivity_.soft_ceiling(needle);
  const double backed = std::isnan(needle) ? needle : std::clamp(needle, -backing, backing);
  const bool lowered = std::abs(needle) > std::abs(backed) + noticed;
  answered_ = hold_damper_.force(step, lowered ? coupling_.stiffness : known_.stiffness, may_be_held);
  double wanted = backed + answered_;
  if (!may_be_held) wanted += drag + (followed ? passivity_.damping_force(speed) : 0.0);
  const double allowed = passivity_.ceiling(wanted);
  const double felt = std::isnan(wanted) ? wanted : std::clamp(wanted, -allowed, allowed);
  lowered_ += followed && (lowered || std::abs(wanted) > std::abs(felt) + noticed);
  return felt;
}

double Servo::across(const Vec3& force) const noexcept {
  return (force - forward_.dot(force) * forward_).norm();
}

}  // namespace acus::haptics
