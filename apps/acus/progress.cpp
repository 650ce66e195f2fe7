#include "progress.h"

#include <unistd.h>

#include <algorithm>
#include <cstdio>

namespace acus::app {
namespace {

constexpr int bar_width = 30;                                // characters
constexpr std::chrono::milliseconds between_two_looks{100};  // no eye follows faster
constexpr const char* clear_line = "\r\033[K";

}  // namespace

Progress::Progress(std::string unit, long total, bool quiet)
    : unit_(std::move(unit)), total_(std::max(1L, total)), shown_(!quiet && isatty(STDERR_FILENO) != 0) {}

Progress::~Progress() {
  if (shown_) std::fputs(clear_line, stderr);
}

void Progress::say(const std::string& sentence) {
  std::fprintf(stderr, "%s%s\n", shown_ ? clear_line : "", sentence.c_str());
}

void Progress::update(long completed) {
  const Clock::time_point now = Clock::now();
  if (!shown_ || completed <= 0 || now - last_shown_ < between_two_looks) return;
  last_shown_ = now;
  const double elapsed = std::chrono::duration<double>(now - start_).count();
  const double rate = static_cast<double>(completed) / elapsed;
  const double left = static_cast<double>(total_ - completed) / rate;
  const auto filled = static_cast<std::size_t>(bar_width * completed / total_);
  const std::string bar = std::string(filled, '#') + std::string(bar_width - filled, '.');
  std::fprintf(stderr, "%s[%s] %3ld %%  %.0f %ss/s  %.0f s left", clear_line, bar.c_str(),
               100 * completed / total_, rate, unit_.c_str(), left);
}

}  // namespace acus::app
