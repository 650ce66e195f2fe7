// acus serve: a scene under a hand, in real time.
#include <cstdio>
#include <optional>

#include "acus/haptics/backends.h"
#include "acus/haptics/haptic_loop.h"
#include "acus/haptics/stop_after.h"
#include "acus/haptics/virtual_coupling.h"
#include "acus/io/insertion.h"
#include "acus/io/scene_toml.h"
#include "interruption.h"
#include "recording.h"
#include "verbs.h"

namespace acus::app {

int do_serve(const ServeOptions& options) {
  const Result<Scene> scene = io::read_scene(options.scene, options.settings);
  if (!scene) return refused(scene.error().sentence, bad_input);
  const Result<haptics::OpenDevice> opened = haptics::open_device(options.device);
  if (!opened) return refused(opened.error().sentence, bad_input);
  haptics::Device& device = *opened->device;
  Result<Simulation> simulation = io::build_simulation(haptics::held_by(device.limits(), *scene));
  if (!simulation) return refused(options.scene + ": " + simulation.error().sentence, bad_input);
  const Result<std::unique_ptr<haptics::Recorder>> recorder =
      start_recorder(options.record_given, options.record, simulation->scene());
  if (!recorder) return refused(recorder.error().sentence, bad_input);
  haptics::LoopSettings settings;
  settings.force_limit = options.force_limit;
  settings.recorder = recorder->get();
  settings.announce = [](haptics::GateFault fault) {
    if (fault == haptics::GateFault::none)
      std::printf("The force is armed again.\n");
    else
      std::printf("Force off: %s. A button of the device arms it again.\n", haptics::in_words(fault).c_str());
    std::fflush(stdout);
  };
  settings.watch = [told = false](const Simulation& now, const haptics::LoopStatus&) mutable {
    if (told || now.frame().health == Health::good) return;
    told = true;
    std::printf("The simulation failed, and the force goes: %s. Ctrl-C ends it.\n",
                complaint(now.frame().health));
    std::fflush(stdout);
  };
  std::printf(
      "Research and training simulator, not a medical device.\n"
      "%s (%s) shows the needle now; it is felt from 5 mm ahead of where the handle is when it becomes "
      "ready.\nCtrl-C ends it.\n",
      device.limits().title.c_str(), opened->by->proof);
  std::fflush(stdout);
  catch_interruptions();
  const haptics::StopAfter stop(options.seconds, interruption_flag());
  const haptics::LoopOutcome outcome = haptics::run_loop(device, *simulation, settings, stop.flag());
  std::optional<Error> not_recorded;
  if (settings.recorder != nullptr) not_recorded = settings.recorder->finish(simulation->state_hash());
  std::fputs(haptics::in_words(outcome.report).c_str(), stdout);
  if (not_recorded) refused(not_recorded->sentence, run_failed);
  if (outcome.lost) return refused(outcome.lost->sentence, run_failed);
  if (outcome.report.health != Health::good)
    return refused("the simulation failed: " + std::string(complaint(outcome.report.health)), run_failed);
  return not_recorded ? run_failed : done;
}

}  // namespace acus::app
