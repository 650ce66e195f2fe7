// The report `loop` of docs/studio-protocol.md, ten times a second.
#pragma once

#include <optional>
#include <string>

#include "acus/haptics/haptic_loop.h"

namespace acus::app {

class StatusClock {
 public:
  // So much was simulated [s], and the processor took so long for it [s].
  void stepped(double simulated, double busy) {
    simulated_ += simulated;
    busy_ += busy;
  }
  // A report where one is due at `now` [s], of the time since the last one. `paused`: the engine's time
  // stands still. `device` where there is one.
  std::optional<std::string> due(double now, bool paused, const haptics::LoopStatus* device = nullptr,
                                 double force_limit = 0.0);

 private:
  double last_ = -1.0;                   // s; negative before the first
  double simulated_ = 0.0, busy_ = 0.0;  // s, since then
};

}  // namespace acus::app
