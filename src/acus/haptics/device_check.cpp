#include "acus/haptics/device_check.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "acus/base/units.h"
#include "acus/haptics/loop_report.h"
#include "acus/haptics/pace.h"
#include "acus/haptics/stop_after.h"

namespace acus::haptics {
namespace {

constexpr double most = 0.5;  // N

class CheckTick final : public Tick {
 public:
  CheckTick(DeviceCheck& check, const DeviceLimits& limits, double duration)
      : check_(check),
        gate_({std::min(most, limits.peak_force), limits.continuous_force, 0.0}),
        towards_person_(-limits.forward),
        duration_(duration) {}

  Wrench operator()(const DeviceState& state) noexcept override {
    const double now = monotonic_time();
    if (last_ > 0.0) check_.period.add(now - last_);
    if (begin_ == 0.0) begin_ = now;
    if (state.ready) {
      ++check_.ready_ticks;
      check_.lowest = check_.lowest.cwiseMin(state.position);
      check_.highest = check_.highest.cwiseMax(state.position);
    }
    const Vec3 force = state.ready ? Vec3(force_at(now - begin_) * towards_person_) : Vec3(Vec3::Zero());
    const GateOutput out = gate_.pass({{force.x(), force.y(), force.z()},
                                       {},
                                       {state.velocity.x(), state.velocity.y(), state.velocity.z()},
                                       0.0,
                                       last_ > 0.0 ? now - last_ : 0.0});
    last_ = now;
    const Vec3 shown(out.force.data());
    check_.largest_force = std::max(check_.largest_force, shown.norm());
    check_.fault = gate_.fault();
    return {shown, Vec3::Zero()};
  }

 private:
  // Nothing in the first quarter, half a wave of a sine in the rest.
  double force_at(double time) const {
    const double phase = (time / duration_ - 0.25) / 0.75;
    return phase > 0.0 && phase < 1.0 ? most * std::sin(phase * 3.14159265358979) : 0.0;
  }

  DeviceCheck& check_;
  ForceGate gate_;
  Vec3 towards_person_;
  double duration_, begin_ = 0.0, last_ = 0.0;  // s
};

}  // namespace

DeviceCheck check_device(Device& device, double duration, const std::atomic<bool>& stop) {
  DeviceCheck check;
  CheckTick tick(check, device.limits(), duration);
  const StopAfter over(duration, stop);
  check.lost = device.serve(tick, over.flag());
  return check;
}

std::string in_words(const DeviceCheck& check, const DeviceLimits& limits) {
  char text[1024];
  std::snprintf(text, sizeof text,
                "Limits   %s: %g N, for long %g N; at most %g N/m (%s)\n"
                "Rate     %.0f ticks a second: half of them within %.3f ms, 99.9 %% within %.3f ms, the "
                "longest %.2f ms\n",
                limits.title.c_str(), limits.peak_force, limits.continuous_force, limits.stiffness,
                limits.source.c_str(), check.period.mean() > 0.0 ? 1.0 / check.period.mean() : 0.0,
                1e3 * check.period.quantile(0.5), 1e3 * check.period.quantile(0.999),
                1e3 * check.period.longest());
  std::string words = text;
  if (check.ready_ticks == 0) return words + "Handle   never ready: is it calibrated and switched on?\n";
  const Vec3 moved = (check.highest - check.lowest) / units::mm;
  std::snprintf(text, sizeof text,
                "Handle   moved over %.1f x %.1f x %.1f mm\nForce    up to %.2f N left the gate%s%s\n",
                moved.x(), moved.y(), moved.z(), check.largest_force,
                check.fault == GateFault::none ? "" : "; then off: ", in_words(check.fault).c_str());
  return words + text;
}

}  // namespace acus::haptics
