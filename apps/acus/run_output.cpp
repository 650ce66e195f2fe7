#include "run_output.h"

#include <chrono>
#include <cstdio>
#include <iostream>
#include <nlohmann/json.hpp>

#include "acus/base/hash.h"
#include "acus/base/units.h"
#include "acus/io/summary_json.h"
#include "acus/sim/names.h"
#include "interruption.h"
#include "progress.h"

namespace acus::app {
namespace {

using io::Insertion;
using Clock = std::chrono::steady_clock;
double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

const char* in_words(Outcome outcome) {
  switch (outcome) {
    case Outcome::straight_puncture:
      return "the needle punctured the tissue without buckling before";
    case Outcome::buckled_then_punctured:
      return "the needle buckled, and punctured the tissue nevertheless";
    case Outcome::never_punctured:
      return "the needle never punctured the tissue";
  }
  return "";
}

void print_events(const Insertion& insertion) {
  std::printf("\n%9s  %-16s %12s %12s %14s\n", "time", "event", "hand travel", "hand force", "free length");
  for (const Event& event : insertion.events)
    std::printf("%7.3f s  %-16s %9.2f mm %10.4f N %11.2f mm\n", event.time, name_of(event.kind).c_str(),
                event.hand_travel / units::mm, event.hand_force, event.free_length / units::mm);
}

void print_summary(const Insertion& insertion, double wall_time, const std::string& out) {
  const Summary& summary = insertion.summary;
  const bool whole = !insertion.interrupted && summary.health == Health::good;
  std::printf("%s%s: %s\n", whole ? "" : "not run to its end; so far ",
              name_of(outcome(insertion.events)).c_str(), in_words(outcome(insertion.events)));
  print_events(insertion);
  std::printf("\npeak hand force   %.4f N at %.2f mm of travel\n", summary.peak_hand_force,
              summary.peak_hand_force_travel / units::mm);
  if (summary.rupture_force) std::printf("tip force at the puncture %.4f N\n", *summary.rupture_force);
  std::printf("largest bow       %.2f mm\n", summary.peak_deflection / units::mm);
  std::printf("energy residual   %.2e J, %.3f %% of the work of the hand\n", summary.peak_energy_residual,
              100.0 * relative_energy_residual(summary));
  std::printf("tissue            %d tetrahedra, %d nodes\n", insertion.tetrahedra, insertion.nodes);
  std::printf("speed             %.1f s simulated in %.1f s, %.1f times real time\n", summary.time, wall_time,
              wall_time > 0.0 ? summary.time / wall_time : 0.0);
  std::printf("state hash        %s\n", hex(insertion.state_hash).c_str());
  if (out.empty())
    std::printf("\nNo files were written; --out DIR keeps trace.csv, events.csv and summary.json.\n");
  else
    std::printf("\nWritten into %s\n", out.c_str());
}

// 0, or the exit code of what went wrong on the way, said on standard error.
int judged(const Insertion& insertion, bool in_files) {
  const std::string when = "at " + std::to_string(insertion.summary.time) + " s";
  if (insertion.summary.health != Health::good)
    return refused("the run failed " + when + ": " + complaint(insertion.summary.health), run_failed);
  if (insertion.interrupted && interrupted())
    return refused("interrupted " + when + (in_files ? "; the files hold the run up to there" : ""),
                   run_failed);
  return done;
}

}  // namespace

std::optional<std::string> complaint(const OutputOptions& options) {
  if (options.vtu_every > 0 && options.out.empty())
    return "--vtu-every needs a folder for its frames; add --out DIR";
  if (options.out_given && options.out.empty())
    return "--out is empty; name a folder, or leave --out away to keep nothing";
  return std::nullopt;
}

Result<RunOutput> RunOutput::create(const OutputOptions& options) {
  RunOutput output(options);
  if (options.out.empty()) return output;
  Result<io::RunFolder> made = io::RunFolder::create(options.out, options.vtu_every);
  if (!made) return made.error();
  output.folder_.emplace(std::move(made).value());
  return output;
}

Insertion RunOutput::follow(Simulation& simulation, int steps, const io::NextTravel& next,
                            const io::Observer& also) {
  catch_interruptions();
  const auto start = Clock::now();
  double writing = 0.0;  // s of wall time that was not spent on steps
  Progress progress("step", steps, options_.quiet);
  const Insertion insertion =
      io::run_insertion(simulation, next, [&, completed = 0L](const Simulation& now) mutable {
        const auto before = Clock::now();
        progress.update(completed++);
        const bool written = !folder_ || folder_->record(now);
        const bool wanted = also(now);
        writing += seconds_since(before);
        return written && wanted && !interrupted();
      });
  wall_time_ = seconds_since(start) - writing;
  return insertion;
}

int RunOutput::finish(const Insertion& insertion) {
  if (folder_)
    if (const auto failed = folder_->finish(insertion, wall_time_))
      return refused(failed->sentence, run_failed);
  if (options_.json)
    std::cout << io::json_text(io::summary_json(insertion, wall_time_)) << std::flush;
  else if (!options_.quiet)
    print_summary(insertion, wall_time_, options_.out);
  return judged(insertion, folder_.has_value());
}

}  // namespace acus::app
