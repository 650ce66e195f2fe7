#include "acus/haptics/handle.h"

#include <algorithm>
#include <cmath>

namespace acus::haptics {

Handle::Handle(const DeviceLimits& limits, const HandModel& hand, const Vec3& position)
    : limits_(limits), hand_(hand), position_(position) {}

void Handle::advance_to(double time, const HandAim& aim) {
  constexpr double longest = 20e-6;  // s
  const double start = time_;
  const int steps = std::max(1, static_cast<int>(std::ceil((time - start) / longest - 1e-9)));
  const double h = (time - start) / steps;
  for (int i = 1; i <= steps; ++i) {
    const double middle = start + (i - 0.5) * h;
    while (count_ > 0 && commands_[first_].from <= middle) {
      device_force_ = commands_[first_].force;
      first_ = (first_ + 1) % most_commands;
      --count_;
    }
    substep(h, {aim.position - (time - middle) * aim.velocity, aim.velocity});
  }
  time_ = time;
}

void Handle::command(const Vec3& force) {
  if (count_ == most_commands) first_ = (first_ + 1) % most_commands, --count_;
  commands_[(first_ + count_++) % most_commands] = {time_ + limits_.delay, force};
}

Vec3 Handle::encoder() const {
  if (limits_.quantum <= 0.0) return position_;
  return (position_ / limits_.quantum).array().round() * limits_.quantum;
}

// Without what its mass and damper take, which move with the handle.
Vec3 Handle::hand_force(const HandAim& aim) const {
  return hand_.stiffness * (aim.position - position_) + hand_.damping * aim.velocity;
}

void Handle::substep(double h, const HandAim& aim) {
  const double mass = limits_.mass + hand_.mass;
  const double drag = std::exp(-(limits_.viscous + hand_.damping) * 0.5 * h / mass);
  const Vec3 before = velocity_;
  position_ += 0.5 * h * velocity_;
  const Vec3 hand = hand_force(aim);
  velocity_ = drag * velocity_ + h / mass * (device_force_ + hand);
  const double speed = velocity_.norm(), brake = limits_.coulomb * h / mass;
  velocity_ *= speed > brake ? drag * (1.0 - brake / speed) : 0.0;
  position_ += 0.5 * h * velocity_;
  // At the port: all that the hand does to the device, what its own mass and damper take off.
  const Vec3 mean = 0.5 * (velocity_ + before);
  const Vec3 at_port = hand - hand_.damping * mean - hand_.mass / h * (velocity_ - before);
  port_energy_ += h * at_port.dot(mean);
}

}  // namespace acus::haptics
