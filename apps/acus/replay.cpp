// acus replay: the hand of a recording again, in the recorded scene or in another.
#include "acus/io/replay.h"

#include <cstdio>

#include "acus/io/insertion.h"
#include "run_output.h"
#include "verbs.h"

namespace acus::app {
namespace {

// Says whether the bits were the same, where that is known; the exit code.
int verdict(const io::HashCheck& check, const io::Recording& recording, const ReplayOptions& options) {
  if (const auto difference = check.difference()) {
    const std::string versions = io::version_difference(recording);
    return refused(options.recording + ": the replay differs: " + *difference +
                       (versions.empty() ? "" : "\nthe recording is of another program: " + versions),
                   run_failed);
  }
  if (recording.hashes.empty()) return done;
  const bool all_compared = check.compared() == static_cast<int>(recording.hashes.size());
  if (all_compared && !options.output.quiet && !options.output.json)
    std::printf("\nThe same bits: the %d recorded states of %zu steps came out again.\n", check.compared(),
                recording.travels.size());
  return done;
}

}  // namespace

int do_replay(const ReplayOptions& options) {
  if (const auto wrong = complaint(options.output)) return refused(*wrong, bad_input);
  const Result<io::Recording> recording = io::read_recording(options.recording);
  if (!recording) return refused(recording.error().sentence, bad_input);
  Result<Simulation> simulation = io::build_replay(*recording, options.settings);
  if (!simulation) return refused(options.recording + ": " + simulation.error().sentence, bad_input);
  Result<RunOutput> output = RunOutput::create(options.output);
  if (!output) return refused(output.error().sentence, bad_input);

  const bool same_scene = options.settings.empty();
  io::HashCheck check(*recording);
  const auto look = [&](const Simulation& now) { return !same_scene || check(now); };
  const auto steps = static_cast<int>(recording->travels.size());
  const io::Insertion insertion = output->follow(*simulation, steps, io::following(recording->travels), look);

  const int code = output->finish(insertion);
  if (!recording->loss.empty()) std::fprintf(stderr, "acus: %s\n", recording->loss.c_str());
  if (same_scene) {
    const int same = verdict(check, *recording, options);
    return code == done ? same : code;
  }
  if (!options.output.quiet && !options.output.json)
    std::printf("\nThe recorded hand in another scene: nothing was compared with the recording.\n");
  return code;
}

}  // namespace acus::app
