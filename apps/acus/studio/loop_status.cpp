#include "loop_status.h"

#include <nlohmann/json.hpp>

namespace acus::app {
namespace {

const char* name_of(haptics::GateState state) {
  switch (state) {
    case haptics::GateState::disarmed:
      return "disarmed";
    case haptics::GateState::ramping:
      return "ramping";
    case haptics::GateState::armed:
      return "armed";
  }
  return "";
}

}  // namespace

std::optional<std::string> StatusClock::due(double now, bool paused, const haptics::LoopStatus* device,
                                            double force_limit) {
  constexpr double between = 0.1;  // s
  if (last_ >= 0.0 && now - last_ < between) return std::nullopt;
  const double passed = last_ >= 0.0 ? now - last_ : 0.0;
  last_ = now;
  nlohmann::ordered_json report = {{"type", "loop"},
                                   {"real_time_factor", passed > 0.0 ? simulated_ / passed : 0.0},
                                   {"load", simulated_ > 0.0 ? busy_ / simulated_ : 0.0},
                                   {"paused", paused}};
  simulated_ = busy_ = 0.0;
  if (device != nullptr) {
    report["late_ticks"] = device->late_ticks;
    report["tick_p999_s"] = device->tick_p999;
    report["gate"] = name_of(device->gate);
    report["fault"] = haptics::in_words(device->fault);
    report["device_force_N"] = device->device_force;
    report["force_limit_N"] = force_limit;
  }
  return report.dump();
}

}  // namespace acus::app
