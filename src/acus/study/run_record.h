// RunRecord: a finished run as its folder tells it, so that a run of yesterday and one of now are the same
// thing.
#pragma once

#include <map>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "acus/base/result.h"
#include "acus/study/snapshot.h"
#include "acus/study/study.h"

namespace acus::study {

struct EventRecord {
  std::string event;
  double time = 0.0;         // s
  double hand_travel = 0.0;  // m
  double hand_force = 0.0;   // N
  double free_length = 0.0;  // m
};

struct RunRecord {
  Case chosen;
  Scene scene;
  std::shared_ptr<const nlohmann::json> summary;  // an object; never null in a record that was read
  std::map<std::string, std::vector<double>>
      trace;  // column of trace.csv -> values; `stage` is not among them
  std::vector<EventRecord> events;
  std::vector<Snapshot> snapshots;
};

// The column of that name; every record has those of trace.csv.
const std::vector<double>& column(const RunRecord& record, const std::string& name);
// The first event of that name.
const EventRecord* find_event(const RunRecord& record, const std::string& event);
const Snapshot* find_snapshot(const RunRecord& record, Moment moment);

// Whether the run came to its end; the numbers of another one need not be finite.
bool completed(const RunRecord& record);
// What the summary says at a JSON pointer, as in "/mesh/tetrahedra": NaN, nothing or 0 where it is absent or
// no such thing. (What is not finite is null in JSON.)
double summary_number(const RunRecord& record, const char* pointer);
std::string summary_text(const RunRecord& record, const char* pointer);
long summary_count(const RunRecord& record, const char* pointer);

// Names what a run depends on: the scene, what stands in its mesh file, the event that ends it, and the
// program that runs.
std::string fingerprint(const Run& run);

// Whether `folder` holds a finished run with that fingerprint.
bool is_finished(const std::string& folder, const std::string& fingerprint);

// Takes away the mark of a finished run, before its files are written again.
void mark_unfinished(const std::string& folder);

// Adds the snapshots to a run whose other files are complete, and at the very end the mark that is_finished()
// sees.
std::optional<Error> mark_finished(const std::string& folder, const std::vector<Snapshot>& snapshots,
                                   const std::string& fingerprint);

// Why the trace of that scene would be too long for read_run(), and what would be right; empty when it is
// not.
std::string trace_complaint(const Scene& scene);

Result<RunRecord> read_run(const std::string& folder, const Run& run);

}  // namespace acus::study
