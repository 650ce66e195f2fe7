// What a device can do and what it is made of: one row of devices.toml.
#pragma once

#include <string>
#include <vector>

#include "acus/base/result.h"
#include "acus/base/vec.h"

namespace acus::haptics {

struct DeviceLimits {
  std::string name;               // of the row: "touch"
  std::string title;              // for people: "3D Systems Touch (Phantom Omni)"
  std::string source;             // where the numbers come from
  double peak_force = 0.0;        // N
  double continuous_force = 0.0;  // N, what it may show on the mean of 10 s
  double peak_torque = 0.0;       // N m; 0 where it shows none
  double stiffness = 0.0;         // N/m, the stiffest spring its maker lets it show
  double mass = 0.0;              // kg, moved at the handle
  double viscous = 0.0;           // N s/m, friction that grows with speed
  double coulomb = 0.0;           // N, dry friction
  double quantum = 0.0;           // m, of a position
  double delay = 0.0;             // s, from a position to the force that answers it, beyond the tick itself
  Vec3 forward =
      Vec3(0.0, 0.0, -1.0);  // unit vector in the device's frame, away from the person who holds it
};

// The rows of devices.toml as built into the program, in alphabetical order.
const std::vector<DeviceLimits>& known_devices();

// The row of that name; null if there is none.
const DeviceLimits* find_device_limits(const std::string& name);

}  // namespace acus::haptics
