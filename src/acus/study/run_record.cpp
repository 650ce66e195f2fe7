#include "acus/study/run_record.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string_view>

#include "acus/base/decimal.h"
#include "acus/io/insertion.h"
#include "acus/io/output_file.h"
#include "acus/io/scene_toml.h"
#include "acus/io/summary_json.h"
#include "acus/io/text_file.h"
#include "acus/io/trace_csv.h"
#include "acus/study/markup.h"
#include "acus/study/text_hash.h"

namespace acus::study {
namespace {

constexpr std::size_t longest_file = std::size_t{1} << 30;  // bytes; a trace of a minute is 20 MB
constexpr const char* finished_mark = "finished";

std::vector<std::string_view> split(std::string_view text, char by) {
  std::vector<std::string_view> parts;
  while (true) {
    const auto end = text.find(by);
    parts.push_back(text.substr(0, end));
    if (end == std::string_view::npos) return parts;
    text.remove_prefix(end + 1);
  }
}

// Puts the number that is the whole of `text` behind the others; false when there is none.
bool append_number(std::string_view text, std::vector<double>& values) {
  const std::string copy(text);
  char* end = nullptr;
  values.push_back(std::strtod(copy.c_str(), &end));
  return !copy.empty() && end == copy.c_str() + copy.size();
}

Error damaged(const std::string& path, const std::string& how) {
  return Error{joined({path, how, "; run the study again without --resume"})};
}

Error damaged_row(const std::string& path, std::size_t row) {
  return damaged(path, joined({":", std::to_string(row + 1), ": is no row of such a file"}));
}

// Rows of comma-separated text without its last empty line.
std::vector<std::vector<std::string_view>> csv_rows(std::string_view text) {
  std::vector<std::vector<std::string_view>> rows;
  for (std::string_view line : split(text, '\n')) {
    if (!line.empty()) rows.push_back(split(line, ','));
  }
  return rows;
}

std::optional<Error> read_trace(const std::string& path, RunRecord& record) {
  const Result<std::string> text = io::read_text(path, longest_file);
  if (!text) return text.error();
  if (!text->starts_with(io::trace_csv_header()))
    return damaged(path, ": has other columns than this version of acus writes");
  const auto rows = csv_rows(*text);
  if (rows.size() < 2) return damaged(path, ": holds no rows");
  for (std::size_t c = 0; c < rows[0].size(); ++c) {
    const bool words = rows[0][c] == "stage";
    std::vector<double> values;
    values.reserve(rows.size() - 1);
    for (std::size_t r = 1; r < rows.size(); ++r) {
      const bool whole = rows[r].size() == rows[0].size();
      if (!whole || (!words && !append_number(rows[r][c], values))) return damaged_row(path, r);
    }
    if (!words) record.trace[std::string(rows[0][c])] = std::move(values);
  }
  return std::nullopt;
}

std::optional<Error> read_events(const std::string& path, RunRecord& record) {
  const Result<std::string> text = io::read_text(path, longest_file);
  if (!text) return text.error();
  if (!text->starts_with(io::events_csv_header()))
    return damaged(path, ": has other columns than this version of acus writes");
  const auto rows = csv_rows(*text);
  for (std::size_t r = 1; r < rows.size(); ++r) {
    // time_s, event, hand_travel_m, hand_force_N, free_length_m
    std::vector<double> values;
    if (rows[r].size() != 5 || !append_number(rows[r][0], values) || !append_number(rows[r][2], values) ||
        !append_number(rows[r][3], values) || !append_number(rows[r][4], values))
      return damaged_row(path, r);
    record.events.push_back({std::string(rows[r][1]), values[0], values[1], values[2], values[3]});
  }
  return std::nullopt;
}

Result<nlohmann::json> read_json(const std::string& path) {
  const Result<std::string> text = io::read_text(path, longest_file);
  if (!text) return text.error();
  nlohmann::json json = nlohmann::json::parse(*text, nullptr, false);
  if (json.is_discarded()) return damaged(path, ": is not JSON");
  return json;
}

const nlohmann::json* in_summary(const RunRecord& record, const char* pointer) {
  const nlohmann::json::json_pointer at(pointer);
  return record.summary->contains(at) ? &record.summary->at(at) : nullptr;
}

// The program that runs, to the byte: one that was built again may give other numbers under the same version.
// Where the system does not show it, the versions must do.
std::uint64_t hash_of_program() {
  const std::uint64_t versions = hash_of_text(io::versions_json().dump());
  const Result<std::string> bytes = io::read_text("/proc/self/exe", longest_file);
  return bytes ? hash_of_text(*bytes, versions) : versions;
}

}  // namespace

const std::vector<double>& column(const RunRecord& record, const std::string& name) {
  return record.trace.at(name);
}

const EventRecord* find_event(const RunRecord& record, const std::string& event) {
  for (const EventRecord& one : record.events) {
    if (one.event == event) return &one;
  }
  return nullptr;
}

const Snapshot* find_snapshot(const RunRecord& record, Moment moment) {
  for (const Snapshot& shot : record.snapshots) {
    if (shot.moment == moment) return &shot;
  }
  return nullptr;
}

bool completed(const RunRecord& record) {
  const nlohmann::json* found = in_summary(record, "/completed");
  return found != nullptr && found->is_boolean() && found->get<bool>();
}

double summary_number(const RunRecord& record, const char* pointer) {
  const nlohmann::json* found = in_summary(record, pointer);
  return found != nullptr && found->is_number() ? found->get<double>() : std::nan("");
}

std::string summary_text(const RunRecord& record, const char* pointer) {
  const nlohmann::json* found = in_summary(record, pointer);
  return found != nullptr && found->is_string() ? found->get<std::string>() : std::string();
}

long summary_count(const RunRecord& record, const char* pointer) {
  const nlohmann::json* found = in_summary(record, pointer);
  return found != nullptr && found->is_number_integer() ? found->get<long>() : 0;
}

std::string fingerprint(const Run& run) {
  const Scene& scene = run.scene;
  static const std::uint64_t program = hash_of_program();
  std::uint64_t hash = hash_of_text(joined({io::scene_toml(scene), run.until}), program);
  if (!scene.tissue.mesh.empty()) {
    // A mesh is named by its file; what counts is what stands in it. One that cannot be read fails when it is
    // built.
    if (const Result<std::string> mesh = io::read_text(scene.tissue.mesh, longest_file))
      hash = hash_of_text(*mesh, hash);
  }
  return hex(hash);
}

bool is_finished(const std::string& folder, const std::string& fingerprint) {
  std::error_code missing;
  const std::filesystem::path mark = std::filesystem::path(folder) / finished_mark;
  if (!std::filesystem::exists(mark, missing)) return false;
  const Result<std::string> text = io::read_text(mark.string(), longest_file);
  return text && *text == fingerprint + "\n";
}

void mark_unfinished(const std::string& folder) {
  std::error_code ignored;
  std::filesystem::remove(std::filesystem::path(folder) / finished_mark, ignored);
}

std::optional<Error> mark_finished(const std::string& folder, const std::vector<Snapshot>& snapshots,
                                   const std::string& fingerprint) {
  const std::filesystem::path at(folder);
  if (auto wrong = io::write_file((at / "snapshots.json").string(), to_json(snapshots).dump() + "\n"))
    return wrong;
  return io::write_file((at / finished_mark).string(), fingerprint + "\n");
}

std::string trace_complaint(const Scene& scene) {
  constexpr double widest_cell = 25.0;  // bytes: "-1.2345678901234567e-308,"
  const std::string head = io::trace_csv_header();
  const double steps = io::step_count(scene);
  const auto columns = static_cast<double>(std::count(head.begin(), head.end(), ',') + 1);
  const double most_rows =
      static_cast<double>(longest_file) / (widest_cell * columns) - 3.0;  // head and ends
  if (steps / scene.run.trace_stride <= most_rows) return {};
  return joined({"run.trace_stride must be at least ", decimal_text(std::ceil(steps / most_rows)), " for ",
                 decimal_text(steps), " steps, but is ", std::to_string(scene.run.trace_stride),
                 ": a longer trace cannot be read back for the report"});
}

Result<RunRecord> read_run(const std::string& folder, const Run& run) {
  const std::filesystem::path at(folder);
  RunRecord record{run.chosen, run.scene, {}, {}, {}, {}};
  if (auto wrong = read_trace((at / "trace.csv").string(), record)) return *wrong;
  if (auto wrong = read_events((at / "events.csv").string(), record)) return *wrong;
  Result<nlohmann::json> summary = read_json((at / "summary.json").string());
  if (!summary) return summary.error();
  if (!summary->is_object()) return damaged((at / "summary.json").string(), ": holds no summary");
  record.summary = std::make_shared<const nlohmann::json>(std::move(*summary));
  const Result<nlohmann::json> shots = read_json((at / "snapshots.json").string());
  if (!shots) return shots.error();
  Result<std::vector<Snapshot>> snapshots = snapshots_from_json(*shots);
  if (!snapshots)
    return damaged((at / "snapshots.json").string(), joined({": ", snapshots.error().sentence}));
  record.snapshots = std::move(*snapshots);
  return record;
}

}  // namespace acus::study
