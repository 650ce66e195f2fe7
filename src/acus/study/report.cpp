#include "acus/study/report.h"

#include <algorithm>
#include <cmath>
#include <map>

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
    case Exhibit::map:
      return show_map(page, group);
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
      ++tally.outcomes[in_words(run.summary.value("outcome", ""))];
      if (!run.summary.value("completed", false)) ++tally.unfinished;
      const double residual = run.summary.value("/energy/relative_residual"_json_pointer, 0.0);
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
  std::vector<std::string> items{
      joined({std::to_string(tally.runs), " insertions: ", outcomes, "."}),
      joined({"Energy: the ledger accounts for the work of the hand but for ", share(tally.worst_residual),
              tally.worst_run.empty() ? "." : joined({" at worst (", tally.worst_run, ")."})})};
  if (tally.unfinished > 0)
    items.push_back(joined({std::to_string(tally.unfinished),
                            " runs ended early; the table at the end names them and says why."}));
  page.list(items);
  if (groups.empty() || groups[0].runs.empty()) return;
  const nlohmann::json versions = groups[0].runs[0].summary.value("versions", nlohmann::json::object());
  page.note(joined({"Made by acus ", versions.value("acus", "?"), ", ", versions.value("compiler", "?"), ", ",
                    versions.value("build_type", "?"), ", Eigen ", versions.value("eigen", "?"),
                    ". The same study gives the same numbers again, on any number of cores."}));
}

void write_runs(Page& page, const std::vector<GroupRecords>& groups) {
  page.heading(2, "runs", "Every run");
  page.paragraphs(
      "Each run has a folder of its own beside this file, study/run, with its trace (one row a millisecond), "
      "its events and a summary with "
      "the whole scene. The hash names the final state to the bit.");
  Table table{
      "",
      {"study / run", "outcome", "health", "peak force, N", "tetrahedra", "steps", "hash of the final state"},
      {}};
  for (const GroupRecords& group : groups) {
    for (const RunRecord& run : group.runs)
      table.rows.push_back(
          {joined({group.group->name, " / ", run.chosen.name}), in_words(run.summary.value("outcome", "")),
           in_words(run.summary.value("health", "")),
           number(run.summary.value("peak_hand_force_N", std::nan(""))),
           std::to_string(run.summary.value("/mesh/tetrahedra"_json_pointer, 0)),
           std::to_string(run.summary.value("steps", 0)), run.summary.value("state_hash", "")});
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
    for (Exhibit exhibit : group.group->report.show) show(page, exhibit, group);
  }
  if (study.contradictions) show_contradictions(page);
  write_runs(page, groups);
  return {page.document(), page.pictures()};
}

}  // namespace acus::study
