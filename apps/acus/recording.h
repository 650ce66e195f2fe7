// The option --record, for whatever takes steps.
#pragma once

#include <memory>
#include <string>

#include "acus/haptics/recorder.h"
#include "acus/sim/scene.h"

namespace acus::app {

// Null where none was asked for.
Result<std::unique_ptr<haptics::Recorder>> start_recorder(bool asked_for, const std::string& file,
                                                          const Scene& scene);

}  // namespace acus::app
