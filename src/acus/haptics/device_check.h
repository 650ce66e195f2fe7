// A first look at a device: does it tick, does it know where it is, and does a little force come out of it.
#pragma once

#include "acus/haptics/device.h"
#include "acus/haptics/duration_histogram.h"
#include "acus/haptics/force_gate.h"

namespace acus::haptics {

struct DeviceCheck {
  DurationHistogram period;  // from one tick to the next
  long ready_ticks = 0;
  Vec3 lowest = Vec3::Constant(1e9), highest = Vec3::Constant(-1e9);  // m, of where the handle was
  double largest_force = 0.0;                                         // N, that left the gate
  GateFault fault = GateFault::none;
  std::optional<Error> lost;  // how the device was lost, if it was
};

// Runs the device for `duration` [s]: without force for the first quarter, then towards the person who holds
// it, growing to half a newton and back to nothing by the end. `stop` ends it earlier.
DeviceCheck check_device(Device& device, double duration, const std::atomic<bool>& stop);

// Some lines for people, each ended.
std::string in_words(const DeviceCheck& check, const DeviceLimits& limits);

}  // namespace acus::haptics
