#include "acus/haptics/servo.h"

#include <algorithm>
#include <array>
#include <cmath>

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
      passivity_(settings.limits, settings.period),
      forward_(settings.limits.forward),
      start_travel_(settings.start_travel),
      hand_travel_(settings.start_travel) {}

// A new word of the simulation says something else about the place where the hand is now. The difference
// fades over as long as that word was awaited, unless the needle has really jumped.
LocalForce Servo::blended(LocalForce local, double now) noexcept {
  local.stiffness = std::clamp(local.stiffness, 0.0, coupling_.stiffness);  // the grip's, or less
  if (local.time != known_.time) {
    constexpr double longest = 5e-3;  // s: later is too late
    const double left = blend_time_ > 0.0 ? std::max(1.0 - (now - blend_from_) / blend_time_, 0.0) : 0.0;
    const bool follows = known_.time >= 0.0 && !local.jumped;
    offset_ = follows ? left * offset_ + force_at(known_, hand_travel_) - force_at(local, hand_travel_) : 0.0;
    if (!std::isfinite(offset_)) offset_ = 0.0;  // one bad word must not spoil those after it
    blend_from_ = now;
    blend_time_ = follows ? std::clamp(local.time - known_.time, 0.0, longest) : 0.0;
    known_ = local;
    passivity_.compare(local.hand.work, local.hand.felt, local.taken, local.stored);
  }
  if (blend_time_ > 0.0) local.force += offset_ * std::max(1.0 - (now - blend_from_) / blend_time_, 0.0);
  return local;
}

Wrench Servo::tick(const DeviceState& device, const LocalForce& local) noexcept {
  if (device.ready && !placed_) {
    origin_ = device.position;
    last_tick_ = device.time;
    placed_ = true;
    position_ = device.position;
  }
  passivity_.moved(device.position - position_, shown_);
  position_ = device.position;
  Vec3 force = Vec3::Zero();
  if (device.ready && local.time >= 0.0) {
    const Vec3 way = device.position - origin_;
    const double along = forward_.dot(way);
    if (std::isfinite(along)) hand_travel_ = start_travel_ + along;  // else the gate turns the force off
    // The hub stays on the axis of insertion: across it the coupling holds the hand there.
    const double needle = force_at(blended(local, device.time), start_travel_ + along);
    passivity_.felt(start_travel_ + along, needle);
    force = -(needle + passivity_.damping_force(forward_.dot(device.velocity))) * forward_ -
            coupling_.stiffness * (way - along * forward_) - coupling_.damping * device.velocity;
  }
  constexpr double never = 1.0;  // s: older than any age that is followed
  const double age = device.ready && local.time >= 0.0 ? device.time - local.time : never;
  const GateOutput out = gate_.pass({three(force),
                                     {},
                                     three(device.velocity),
                                     std::max(age, 0.0),
                                     device.time - last_tick_,
                                     std::min(passivity_.ceiling(force), passivity_.ceiling(shown_))});
  last_tick_ = device.time;
  shown_ = Vec3(out.force.data());
  return {shown_, Vec3(out.torque.data())};
}

}  // namespace acus::haptics
