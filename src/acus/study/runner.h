// Runner: does the runs of a study, several at a time, and leaves the same files whatever the number of
// workers.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "acus/base/result.h"
#include "acus/study/study.h"

namespace acus::study {

struct Progress {
  long steps_done = 0, steps = 0;  // of all runs
  std::string run;                 // that has just finished, "group/run"; empty for a mere sign of life
  std::string outcome;             // of that run
};

// Steps that the hands of all runs take together.
long step_count(const Study& study);

struct RunnerOptions {
  std::string folder;
  int jobs = 1;
  bool resume = false;  // keep runs that are finished already
  // True ends the study; finished runs stay finished. Every worker asks, each from its own thread.
  std::function<bool()> interrupted;
  std::function<void(const Progress&)> progress;  // called by one thread at a time
};

// Why a study stopped.
struct Failure {
  std::string sentence;
  bool wrong_input = false;  // a scene that cannot be built, and not a full disk, lack of memory and the like
};

// Every run into folder/group/run. The first Failure stops the others; runs that finished stay finished.
std::optional<Failure> do_runs(const Study& study, const RunnerOptions& options);

// Where a run has its files.
std::string run_folder(const std::string& folder, const Group& group, const Run& run);

}  // namespace acus::study
