// One insertion as a user follows it: progress while it runs, files, and a summary at its end. Runs and
// replays share it.
#pragma once

#include <optional>
#include <string>

#include "acus/io/insertion.h"
#include "acus/io/run_folder.h"
#include "verbs.h"

namespace acus::app {

// What is wrong with the options themselves, if anything.
std::optional<std::string> complaint(const OutputOptions& options);

class RunOutput {
 public:
  // Makes the folder, where one is asked for.
  static Result<RunOutput> create(const OutputOptions& options);

  // Takes the steps, `steps` at most, with `also` looking on; Ctrl-C ends them early.
  io::Insertion follow(Simulation& simulation, int steps, const io::NextTravel& next,
                       const io::Observer& also);

  // Ends the files and prints the summary. 0, or the exit code of what went wrong, said on standard error.
  int finish(const io::Insertion& insertion);

 private:
  explicit RunOutput(const OutputOptions& options) : options_(options) {}

  OutputOptions options_;
  std::optional<io::RunFolder> folder_;
  double wall_time_ = 0.0;  // s, of the steps alone
};

}  // namespace acus::app
