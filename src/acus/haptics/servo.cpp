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
      forward_(settings.limits.forward),
      start_travel_(settings.start_travel),
      hub_travel_(settings.start_travel) {}

// A new word of the simulation says something else about the place where the hub is now. The difference fades
// over as long as that word was awaited, unless the needle has really jumped.
LocalForce Servo::blended(const LocalForce& local, double now) noexcept {
  if (local.time != known_.time) {
    constexpr double longest = 30e-3;  // s
    const double left = blend_time_ > 0.0 ? std::max(1.0 - (now - blend_from_) / blend_time_, 0.0) : 0.0;
    const bool follows = known_.time >= 0.0 && !local.jumped;
    offset_ = follows ? left * offset_ + force_at(known_, hub_travel_) - force_at(local, hub_travel_) : 0.0;
    if (!std::isfinite(offset_)) offset_ = 0.0;  // one bad word must not spoil those after it
    blend_from_ = now;
    blend_time_ = follows ? std::clamp(local.time - known_.time, 0.0, longest) : 0.0;
    known_ = local;
  }
  LocalForce now_felt = local;
  if (blend_time_ > 0.0) now_felt.force += offset_ * std::max(1.0 - (now - blend_from_) / blend_time_, 0.0);
  return now_felt;
}

Wrench Servo::tick(const DeviceState& device, const LocalForce& local) noexcept {
  if (device.ready && !placed_) {
    origin_ = device.position;
    last_tick_ = device.time;
    placed_ = true;
  }
  Vec3 force = Vec3::Zero();
  if (device.ready && local.time >= 0.0) {
    const Vec3 way = device.position - origin_;
    const double travel = start_travel_ + forward_.dot(way);
    const double hub = balanced_hub(coupling_, blended(local, device.time), travel);
    if (std::isfinite(hub))
      hub_travel_ = hub;  // else the gate turns the force off, and the simulation lives on
    // The hub stays on the axis of insertion: across it the coupling holds the hand there.
    const Vec3 stretch = way - (hub - start_travel_) * forward_;
    force = -coupling_.stiffness * stretch - coupling_.damping * device.velocity;
  }
  constexpr double never = 1.0;  // s: older than any age that is followed
  const double age = device.ready && local.time >= 0.0 ? device.time - local.time : never;
  const GateOutput out =
      gate_.pass({three(force), {}, three(device.velocity), std::max(age, 0.0), device.time - last_tick_});
  last_tick_ = device.time;
  return {Vec3(out.force.data()), Vec3(out.torque.data())};
}

}  // namespace acus::haptics
