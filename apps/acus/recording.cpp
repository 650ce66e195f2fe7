#include "recording.h"

#include "acus/io/replay.h"

namespace acus::app {

Result<std::unique_ptr<haptics::Recorder>> start_recorder(bool asked_for, const std::string& file,
                                                          const Scene& scene) {
  if (!asked_for) return std::unique_ptr<haptics::Recorder>();
  const Result<io::RecordedScene> recorded = io::recorded_scene(scene);
  if (!recorded) return recorded.error();
  return haptics::Recorder::start(file, *recorded, "--record");
}

}  // namespace acus::app
