// The handle of a device and the hand that holds it, as bodies: what a device does between two ticks. For
// emulators, and for every statement about stability.
#pragma once

#include <array>
#include <cstddef>

#include "acus/haptics/device_limits.h"

namespace acus::haptics {

// What a hand adds to the handle that it holds: mass, and a spring and damper towards where it wants to be.
struct HandModel {
  double mass = 0.0;       // kg
  double damping = 0.0;    // N s/m
  double stiffness = 0.0;  // N/m
};
inline constexpr HandModel no_hand{};
inline constexpr HandModel light_grip{0.1, 1.0, 50.0};
inline constexpr HandModel whole_arm{0.554, 6.45, 135.0};

// Where the hand wants to be, and how fast it goes there.
struct HandAim {
  Vec3 position = Vec3::Zero();  // m
  Vec3 velocity = Vec3::Zero();  // m/s
};

// A mass with viscous and dry friction under the device's force, which comes `delay` after it was commanded,
// and the hand's.
class Handle {
 public:
  Handle(const DeviceLimits& limits, const HandModel& hand, const Vec3& position = Vec3::Zero());

  // Lets time go on to `time` [s], in steps of 20 us: exact friction between kicks of the forces, the energy
  // of a free oscillation true to 1e-6.
  void advance_to(double time, const HandAim& aim);

  // Another hand takes the handle, or none.
  void change_hand(const HandModel& hand) { hand_ = hand; }

  // From now + delay on, the device pushes with this force. N. At most 64 commands may be under way; the
  // oldest gives way to a further one.
  void command(const Vec3& force);

  double time() const { return time_; }               // s
  const Vec3& position() const { return position_; }  // m, true
  const Vec3& velocity() const { return velocity_; }  // m/s, true
  // What the encoder says: whole quanta.
  Vec3 encoder() const;
  // J, that the hand has put into the device so far: what a passive device never gives back more of.
  double port_energy() const { return port_energy_; }

 private:
  struct Command {
    double from = 0.0;  // s
    Vec3 force = Vec3::Zero();
  };
  static constexpr std::size_t most_commands = 64;

  Vec3 hand_force(const HandAim& aim) const;
  void substep(double h, const HandAim& aim);

  DeviceLimits limits_;
  HandModel hand_;
  double time_ = 0.0;
  Vec3 position_, velocity_ = Vec3::Zero();
  Vec3 device_force_ = Vec3::Zero();
  std::array<Command, most_commands> commands_;
  std::size_t first_ = 0, count_ = 0;
  double port_energy_ = 0.0;
};

}  // namespace acus::haptics
