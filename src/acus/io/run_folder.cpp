#include "acus/io/run_folder.h"

#include <filesystem>
#include <nlohmann/json.hpp>

#include "acus/io/summary_json.h"
#include "acus/io/trace_csv.h"

namespace acus::io {
namespace {

constexpr const char* drawings_folder = "frames";
constexpr int needle_points = 101;  // along the drawn needle: straight pieces of 2 mm at 200 mm

std::string six_digits(int number) {
  const std::string digits = std::to_string(number);
  return std::string(digits.size() < 6 ? 6 - digits.size() : 0, '0') + digits;
}

// What a run leaves only at its end, or only when asked to draw: else it would stand beside another run's
// trace.
void remove_earlier_run(const std::string& path) {
  std::error_code unchanged;  // what cannot be removed is replaced later, or says so then
  for (const char* name : {"/summary.json", "/frames.pvd"}) std::filesystem::remove(path + name, unchanged);
  std::filesystem::directory_iterator drawings(path + "/" + drawings_folder, unchanged);
  for (; !unchanged && drawings != std::filesystem::directory_iterator(); drawings.increment(unchanged)) {
    const std::string kind = drawings->path().extension().string();
    std::error_code kept;
    if (kind == ".vtu" || kind == ".vtp") std::filesystem::remove(drawings->path(), kept);
  }
}

}  // namespace

Result<RunFolder> RunFolder::create(const std::string& path, int vtu_every) {
  const std::string deepest = vtu_every > 0 ? path + "/" + drawings_folder : path;
  if (auto failed = make_folder(path)) return *failed;
  if (auto failed = make_folder(deepest)) return *failed;
  remove_earlier_run(path);
  Result<OutputFile> trace = OutputFile::create(path + "/trace.csv");
  if (!trace) return trace.error();
  Result<OutputFile> events = OutputFile::create(path + "/events.csv");
  if (!events) return events.error();
  trace->write(trace_csv_header());
  events->write(events_csv_header());
  return RunFolder(path, vtu_every, std::move(trace).value(), std::move(events).value());
}

void RunFolder::write_row(const Frame& frame) {
  trace_.write(trace_csv_row(frame));
  last_row_time_ = frame.time;
}

bool RunFolder::record(const Simulation& simulation) {
  if (states_ % simulation.scene().run.trace_stride == 0) write_row(simulation.frame());
  const auto events = simulation.events();
  for (; events_written_ < events.size(); ++events_written_)
    events_.write(events_csv_row(events[events_written_]));
  if (vtu_every_ > 0 && states_ % vtu_every_ == 0 && !failure_) failure_ = write_drawing(simulation);
  ++states_;
  return !failure_ && !trace_.failed() && !events_.failed();
}

std::optional<Error> RunFolder::write_drawing(const Simulation& simulation) {
  const std::string number = six_digits(states_ / vtu_every_);
  const auto write = [&](int part, const std::string& name, const std::string& text) {
    drawings_.push_back({simulation.frame().time, part, std::string(drawings_folder) + "/" + name});
    return write_file(path_ + "/" + drawings_.back().file, text);
  };
  if (!simulation.tissue().nodes.empty()) {
    const std::vector<Vec3> velocities = simulation.velocities();
    const std::vector<double> von_mises = simulation.von_mises();
    const TissueState tissue{simulation.tissue(), simulation.positions(), velocities, von_mises};
    if (auto failed = write(0, "tissue_" + number + ".vtu", tissue_vtu(tissue))) return failed;
  }
  return write(1, "needle_" + number + ".vtp", needle_vtp(simulation.needle_line(needle_points)));
}

std::optional<Error> RunFolder::finish(const Insertion& insertion, std::optional<double> wall_time) {
  const Frame& last = insertion.last;
  if (last.time > last_row_time_) write_row(last);
  const std::optional<Error> ends[] = {
      failure_, trace_.close(), events_.close(),
      vtu_every_ > 0 ? write_file(path_ + "/frames.pvd", pvd(drawings_)) : std::nullopt,
      write_file(path_ + "/summary.json", json_text(summary_json(insertion, wall_time)))};
  for (const auto& failed : ends)
    if (failed) return failed;
  return std::nullopt;
}

}  // namespace acus::io
