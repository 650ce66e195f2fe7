// A device that is not there: the handle and the hand of handle.h, ticking by the wall clock. For trying the
// loop without hardware.
#pragma once

#include <functional>

#include "acus/haptics/device.h"
#include "acus/haptics/handle.h"

namespace acus::haptics {

class SimulatedDevice final : public Device {
 public:
  // `plan` says where the hand wants to be, m along limits.forward, at a time in s.
  SimulatedDevice(const DeviceLimits& limits, const HandModel& hand, std::function<double(double)> plan);

  const DeviceLimits& limits() const override { return limits_; }
  std::optional<Error> serve(Tick& tick, const std::atomic<bool>& stop) override;

 private:
  DeviceLimits limits_;
  Handle handle_;
  std::function<double(double)> plan_;
};

// "simulated" or "simulated:ROW" with a row of devices.toml: a light grip that pushes at 10 mm/s after a
// second, 80 mm far.
Result<std::unique_ptr<Device>> open_simulated(const std::string& row);

}  // namespace acus::haptics
