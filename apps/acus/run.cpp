// acus run: one insertion, headless.
#include <memory>

#include "acus/haptics/recorder.h"
#include "acus/io/insertion.h"
#include "acus/io/scene_toml.h"
#include "acus/sim/hand.h"
#include "run_output.h"
#include "verbs.h"

namespace acus::app {
namespace {

using haptics::Recorder;

// Follows the hand of the scene to its end, and writes each step down.
io::Insertion insert(Simulation& simulation, RunOutput& output, Recorder* recorder) {
  const Scene& scene = simulation.scene();
  Hand hand(scene.hand, scene.run.time_step);
  std::optional<double> travel;  // m, the input of the last step
  const auto along_the_hand = [&](const Frame& last) { return travel = hand.next(last.hand_force); };
  const auto write_down = [&, begun = false](const Simulation& now) mutable {
    if (recorder == nullptr || !std::exchange(begun, true)) return true;
    recorder->wait_for_room();
    const bool due = recorder->hash_due();
    recorder->step(*travel, due ? std::optional(now.state_hash()) : std::nullopt);
    return true;
  };
  return output.follow(simulation, io::step_count(scene), along_the_hand, write_down);
}

}  // namespace

int do_run(const RunOptions& options) {
  if (const auto wrong = complaint(options.output)) return refused(*wrong, bad_input);
  const Result<Scene> scene = io::read_scene(options.scene, options.settings);
  if (!scene) return refused(scene.error().sentence, bad_input);
  Result<Simulation> simulation = io::build_simulation(*scene, options.threads);
  if (!simulation) return refused(options.scene + ": " + simulation.error().sentence, bad_input);
  Result<RunOutput> output = RunOutput::create(options.output);
  if (!output) return refused(output.error().sentence, bad_input);
  std::unique_ptr<Recorder> recorder;
  if (options.record_given) {
    Result<std::unique_ptr<Recorder>> started = Recorder::start(options.record, *scene, "--record");
    if (!started) return refused(started.error().sentence, bad_input);
    recorder = std::move(*started);
  }

  const io::Insertion insertion = insert(*simulation, *output, recorder.get());
  std::optional<Error> not_recorded;
  if (recorder) not_recorded = recorder->finish(insertion.state_hash);
  const int code = output->finish(insertion);
  return not_recorded ? refused(not_recorded->sentence, run_failed) : code;
}

}  // namespace acus::app
