// A line on standard error that says how far long work has come; silent unless that is a terminal.
#pragma once

#include <chrono>
#include <string>

namespace acus::app {

class Progress {
 public:
  // `total` steps, called `unit` in the line: "step", "run".
  Progress(std::string unit, long total, bool quiet = false);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  void update(long completed);
  // A line that stays, on a terminal or not.
  void say(const std::string& sentence);

 private:
  using Clock = std::chrono::steady_clock;

  std::string unit_;
  long total_;
  bool shown_;
  Clock::time_point start_ = Clock::now();
  Clock::time_point last_shown_ = start_;
};

}  // namespace acus::app
