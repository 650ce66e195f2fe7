// The hand of a recording, as a device: it goes where it went, whatever it is shown. For trying other
// needles, tissues and settings of the loop under the same hand, in real time.
#pragma once

#include <string>
#include <vector>

#include "acus/haptics/device.h"

namespace acus::haptics {

class RecordedDevice final : public Device {
 public:
  // `travels` [m], at least one: of the hand along limits.forward at the end of each step of `time_step` > 0
  // [s]. First it rests for a second 5 mm before first touch and glides to where the recording begins.
  RecordedDevice(const DeviceLimits& limits, std::vector<double> travels, double time_step);

  const DeviceLimits& limits() const override { return limits_; }
  // After the last step the hand rests where it is.
  std::optional<Error> serve(Tick& tick, const std::atomic<bool>& stop) override;

  // Where the hand is at a time in s since it was served, m.
  double travel(double time) const;

 private:
  DeviceLimits limits_;
  std::vector<double> travels_;
  double time_step_;
};

// `argument` is the file of a recording.
Result<std::unique_ptr<Device>> open_recorded(const std::string& argument);

}  // namespace acus::haptics
