#include "acus/haptics/recorded_device.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "acus/haptics/pace.h"
#include "acus/io/recording_reader.h"

namespace acus::haptics {
namespace {

constexpr double period = 1e-3;              // s
constexpr double rest = 1.0, glide = 10e-3;  // s, m/s, before the recording begins
constexpr double rest_at = -5e-3;            // m, where the loop begins

}  // namespace

RecordedDevice::RecordedDevice(const DeviceLimits& limits, std::vector<double> travels, double time_step)
    : limits_(limits), travels_(std::move(travels)), time_step_(time_step) {
  assert(!travels_.empty());
}

double RecordedDevice::travel(double time) const {
  const double way = travels_.front() - rest_at, gliding = std::abs(way) / glide;
  const double begun = time - rest - gliding;
  if (begun <= 0.0) return rest_at + std::clamp((time - rest) / std::max(gliding, period), 0.0, 1.0) * way;
  const double step = std::min(begun / time_step_, static_cast<double>(travels_.size() - 1));
  const auto before = static_cast<std::size_t>(step);
  const std::size_t after = std::min(before + 1, travels_.size() - 1);
  return travels_[before] + (step - static_cast<double>(before)) * (travels_[after] - travels_[before]);
}

std::optional<Error> RecordedDevice::serve(Tick& tick, const std::atomic<bool>& stop) {
  const double start = monotonic_time();
  Pace pace(period);
  double before = rest_at, last = 0.0;
  for (; !stop.load(std::memory_order_relaxed); pace.wait()) {
    const double now = monotonic_time() - start, here = travel(now);
    DeviceState state;
    state.time = now;
    state.position = here * limits_.forward;
    if (now > last) state.velocity = (here - before) / (now - last) * limits_.forward;
    state.ready = true;
    before = here;
    last = now;
    tick(state);
  }
  return std::nullopt;
}

Result<std::unique_ptr<Device>> open_recorded(const std::string& argument) {
  if (argument.empty()) return Error{"a recorded hand needs its file, as in recorded:hand.acusrec"};
  Result<io::Recording> recording = io::read_recording(argument);
  if (!recording) return recording.error();
  if (recording->travels.empty()) return Error{argument + ": no step of a hand is in it"};
  if (!std::all_of(recording->travels.begin(), recording->travels.end(),
                   [](double x) { return std::isfinite(x); }))
    return Error{argument + ": the hand in it is nowhere at one of its steps"};
  const DeviceLimits* limits = find_device_limits("touch");
  assert(limits);
  return std::unique_ptr<Device>(std::make_unique<RecordedDevice>(*limits, std::move(recording->travels),
                                                                  recording->scene.run.time_step));
}

}  // namespace acus::haptics
