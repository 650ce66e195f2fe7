#include "acus/study/report.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <set>

#include "acus/base/units.h"
#include "acus/study/exhibits.h"
#include "acus/study/markup.h"

namespace acus::study {
namespace {

void show(Page& page, Exhibit exhibit, const GroupRecords& group) {
  switch (exhibit) {
    case Exhibit::force:
      return show_force(page, group);
    case Exhibit::energy:
      return show_energy(page, group);
    case Exhibit::stages:
      return show_stages(page, group);
    case Exhibit::mesh:
      return show_mesh(page, group);
    case Exhibit::loads:
      return show_loads(page, group);
    case Exhibit::column:
      return show_column(page, group);
    case Exhibit::shapes:
      return show_shapes(page, group);
    case Exhibit::coupling:
      return show_coupling(page, group);
    case Exhibit::convergence:
      return show_convergence(page, group);
    case Exhibit::exactness:
      return show_exactness(page, group);
    case Exhibit::felt:
      return show_felt(page, group);
    case Exhibit::track:
      return show_track(page, group);
    case Exhibit::map:
      return show_map(page, group);
    case Exhibit::depth:
      return show_depth(page, group);
  }
}

struct Tally {
  int runs = 0, unfinished = 0;
  double worst_residual = 0.0;
  std::string worst_run;
  std::map<std::string, int> outcomes;
};

Tally tally_of(const std::vector<GroupRecords>& groups) {
  Tally tally;
  for (const GroupRecords& group : groups) {
    for (const RunRecord& run : group.runs) {
      ++tally.runs;
      if (!completed(run)) {
        ++tally.unfinished;
        continue;
      }
      ++tally.outcomes[in_words(summary_text(run, "/outcome"))];
      const double residual = summary_number(run, "/energy/relative_residual");
      if (residual > tally.worst_residual) {
        tally.worst_residual = residual;
        tally.worst_run = joined({group.group->name, "/", run.chosen.name});
      }
    }
  }
  return tally;
}

void write_summary(Page& page, const std::vector<GroupRecords>& groups) {
  const Tally tally = tally_of(groups);
  std::string outcomes;
  for (const auto& [outcome, count] : tally.outcomes)
    outcomes += joined({outcomes.empty() ? "" : ", ", std::to_string(count), " ", outcome});
  if (tally.unfinished > 0)
    outcomes += joined({outcomes.empty() ? "" : ", ", std::to_string(tally.unfinished), " ended early"});
  std::vector<std::string> items{
      joined({std::to_string(tally.runs), " insertions: ", outcomes, "."}),
      joined({"Energy: the ledger accounts for the work of the hand but for ", share(tally.worst_residual),
              tally.worst_run.empty() ? "." : joined({" at worst (", tally.worst_run, ")."})})};
  if (tally.unfinished > 0)
    items.push_back(
        joined({std::to_string(tally.unfinished), tally.unfinished == 1 ? " run" : " runs",
                " ended early and stand in no picture; the table at the end says which and why."}));
  page.list(items);
  if (groups.empty() || groups[0].runs.empty()) return;
  const RunRecord& first = groups[0].runs[0];
  page.note(
      joined({"Made by acus ", summary_text(first, "/versions/acus"), ", ",
              summary_text(first, "/versions/compiler"), ", ", summary_text(first, "/versions/build_type"),
              ", Eigen ", summary_text(first, "/versions/eigen"),
              ". The same study gives the same numbers again, on any number of cores."}));
}

// How often the traces have a row, in words.
std::string rows_of_traces(const std::vector<GroupRecords>& groups) {
  std::set<std::string> intervals;
  for (const GroupRecords& group : groups) {
    for (const RunRecord& run : group.runs)
      intervals.insert(number(run.scene.run.time_step * run.scene.run.trace_stride / units::ms));
  }
  if (intervals.size() != 1) return "every run.trace_stride steps";
  return *intervals.begin() == "1" ? "a millisecond" : joined({"every ", *intervals.begin(), " ms"});
}

// The exhibits of a group, from the runs that came to their end: the others would give pictures of what
// never was.
void show_group(Page& page, const GroupRecords& group) {
  GroupRecords whole{group.group, {}};
  std::string left_out;
  for (const RunRecord& run : group.runs) {
    if (!completed(run))
      left_out += joined(
          {left_out.empty() ? "" : ", ", run.chosen.name, " (", in_words(summary_text(run, "/health")), ")"});
  }
  if (!left_out.empty()) {
    page.note(joined({"Left out here, because they ended early: ", left_out, "."}));
    std::copy_if(group.runs.begin(), group.runs.end(), std::back_inserter(whole.runs), completed);
    if (whole.runs.empty()) return;
  }
  for (Exhibit exhibit : group.group->report.show) show(page, exhibit, left_out.empty() ? group : whole);
}

void write_runs(Page& page, const std::vector<GroupRecords>& groups) {
  page.heading(2, "runs", "Every run");
  page.paragraphs(
      joined({"Each run has a folder of its own beside this file, study/run, with its trace (one row ",
              rows_of_traces(groups),
              "), its events and a summary with the whole scene. The hash names the final state to "
              "the bit."}));
  Table table{
      "",
      {"study / run", "outcome", "health", "peak force, N", "tetrahedra", "steps", "hash of the final state"},
      {}};
  for (const GroupRecords& group : groups) {
    for (const RunRecord& run : group.runs)
      table.rows.push_back({joined({group.group->name, " / ", run.chosen.name}),
                            completed(run) ? in_words(summary_text(run, "/outcome")) : "ended early",
                            in_words(summary_text(run, "/health")),
                            number(summary_number(run, "/peak_hand_force_N")),
                            std::to_string(summary_count(run, "/mesh/tetrahedra")),
                            std::to_string(summary_count(run, "/steps")), summary_text(run, "/state_hash")});
  }
  page.table(table);
}

}  // namespace

Report build_report(const Study& study, const std::vector<GroupRecords>& groups) {
  Page page(study.title);
  page.paragraphs(study.text);
  write_summary(page, groups);
  for (const GroupRecords& group : groups) {
    // A study of one group has said its title and text already.
    page.heading(2, group.group->name, groups.size() > 1 ? group.group->title : "Results");
    if (groups.size() > 1) page.paragraphs(group.group->text);
    show_group(page, group);
  }
  if (study.contradictions) show_contradictions(page, groups);
  write_runs(page, groups);
  return {page.document(), page.pictures()};
}

}  // namespace acus::study
