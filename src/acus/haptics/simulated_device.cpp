#include "acus/haptics/simulated_device.h"

#include <algorithm>

#include "acus/haptics/pace.h"

namespace acus::haptics {
namespace {

constexpr double period = 1e-3;  // s

}  // namespace

SimulatedDevice::SimulatedDevice(const DeviceLimits& limits, const HandModel& hand,
                                 std::function<double(double)> plan)
    : limits_(limits), handle_(limits, hand), plan_(std::move(plan)) {}

std::optional<Error> SimulatedDevice::serve(Tick& tick, const std::atomic<bool>& stop) {
  const double start = monotonic_time() - handle_.time();
  Pace pace(period);
  Vec3 before = handle_.encoder();
  while (!stop.load(std::memory_order_relaxed)) {
    pace.wait();
    const double now = monotonic_time() - start, elapsed = now - handle_.time();
    const double aim = plan_(now), aim_before = plan_(handle_.time());
    handle_.advance_to(now, {limits_.forward * aim, limits_.forward * ((aim - aim_before) / elapsed)});
    DeviceState state;
    state.time = now;
    state.position = handle_.encoder();
    state.velocity = (state.position - before) / elapsed;
    state.ready = true;
    before = state.position;
    handle_.command(tick(state).force);
  }
  handle_.command(Vec3::Zero());
  return std::nullopt;
}

Result<std::unique_ptr<Device>> open_simulated(const std::string& row) {
  const DeviceLimits* limits = find_device_limits(row.empty() ? "touch" : row);
  if (limits == nullptr) {
    std::string rows;
    for (const DeviceLimits& known : known_devices()) rows += (rows.empty() ? "" : ", ") + known.name;
    return Error{"there is no device '" + row + "' to simulate; there are " + rows};
  }
  const auto push = [](double time) {
    return std::clamp(10e-3 * (time - 1.0), 0.0, 80e-3);
  };  // m, at a time in s
  return std::unique_ptr<Device>(std::make_unique<SimulatedDevice>(*limits, light_grip, push));
}

}  // namespace acus::haptics
