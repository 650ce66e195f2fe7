#include "acus/haptics/loop_report.h"

#include <cstdarg>
#include <cstdio>

#include "acus/sim/summary.h"

namespace acus::haptics {
namespace {

// One line, as printf makes it.
[[gnu::format(printf, 1, 2)]] std::string line(const char* format, ...) {
  char text[512];
  std::va_list values;
  va_start(values, format);
  std::vsnprintf(text, sizeof text, format, values);
  va_end(values);
  return std::string(text) + "\n";
}

std::string load_in_words(const LoopReport& report) {
  const double load = report.step.mean() / report.time_step;
  constexpr double heavy = 0.9;
  if (load > heavy)
    return line(
        "Load     too heavy: a step of %g ms takes %.2f ms, so the needle moves in slow motion (%.2f times "
        "real "
        "time); a coarser tissue (tissue.tetrahedra) or a longer step (run.time_step_ms) helps",
        1e3 * report.time_step, 1e3 * report.step.mean(), real_time_factor(report));
  return line("Load     %.0f %%: a step of %g ms takes %.2f ms, at most %.2f ms; %.2f times real time",
              100.0 * load, 1e3 * report.time_step, 1e3 * report.step.mean(), 1e3 * report.step.longest(),
              real_time_factor(report));
}

std::string gate_in_words(const LoopReport& report) {
  const GateInterventions& gate = report.interventions;
  return line(
      "Gate     largest force %.2f N; slowed in %ld ticks, clamped in %ld, lowered so as to give no energy "
      "away in %ld, "
      "held for a late simulation in %ld%s%s",
      report.largest_force, gate.slew, gate.peak, report.lowered, gate.held,
      report.fault == GateFault::none ? "" : "; force off: ", in_words(report.fault).c_str());
}

}  // namespace

double real_time_factor(const LoopReport& report) {
  return report.wall_time > 0.0 ? report.simulated_time / report.wall_time : 0.0;
}

std::string in_words(GateFault fault) {
  switch (fault) {
    case GateFault::none:
      return "";
    case GateFault::not_finite:
      return "a number was none";
    case GateFault::stale:
      return "the simulation fell silent, or the device was not ready";
    case GateFault::over_speed:
      return "the handle was faster than 1.2 m/s";
    case GateFault::overheated:
      return "more force on the mean of 10 s than the device may show for long";
  }
  return "";
}

std::string in_words(const LoopReport& report) {
  std::string words =
      line("Ticks    %ld, every %.3f ms; %ld late by a whole millisecond or more, the longest after %.2f ms",
           report.period.count(), 1e3 * report.period.mean(), report.period.longer_than(late_tick),
           1e3 * report.period.longest());
  words += line("Tick     %.1f us of work (half of them), 99.9 %% within %.1f us",
                1e6 * report.work.quantile(0.5), 1e6 * report.work.quantile(0.999));
  if (report.step.count() > 0) words += load_in_words(report);
  if (report.age.count() > 0)
    words += line("Age      of the simulation's word in a tick: %.1f ms (half of them), at most %.1f ms",
                  1e3 * report.age.quantile(0.5), 1e3 * report.age.longest());
  words += gate_in_words(report);
  if (report.health != Health::good)
    words += "Needle   the simulation ended: " + std::string(complaint(report.health)) + "\n";
  if (!report.not_real_time.empty()) words += "Time     " + report.not_real_time + "\n";
  return words;
}

}  // namespace acus::haptics
