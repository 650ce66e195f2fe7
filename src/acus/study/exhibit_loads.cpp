// Predicted against simulated loads, run by run.
#include "acus/base/units.h"
#include "acus/sim/support.h"
#include "acus/study/exhibits.h"
#include "acus/study/markup.h"

namespace acus::study {
namespace {

using units::mm;

std::vector<std::string> row_of(const RunRecord& run) {
  std::vector<std::string> row{run.chosen.name, in_words(summary_text(run, "/outcome")),
                               number(critical_load(run.scene))};
  const EventRecord* first = find_event(run, "buckling");
  row.push_back(first == nullptr ? "straight" : number(first->hand_force));
  row.push_back(first == nullptr ? "" : percent_off(first->hand_force, critical_load(run.scene)));
  const EventRecord* puncture = find_event(run, "puncture");
  row.push_back(puncture == nullptr ? "never" : number(puncture->hand_force));
  const EventRecord* second = find_event(run, "second_buckling");
  const double predicted = second == nullptr ? 0.0 : critical_load(run.scene, second->free_length);
  row.push_back(second == nullptr ? "" : number(second->free_length / mm));
  row.push_back(second == nullptr ? "" : number(predicted));
  row.push_back(second == nullptr ? "" : number(second->hand_force));
  row.push_back(second == nullptr ? "" : percent_off(second->hand_force, predicted));
  return row;
}

}  // namespace

void show_loads(Page& page, const GroupRecords& group) {
  Table table{
      "Closed form (Eq. 10 with the factor of the supports, on the free length) against the simulated loads "
      "on the hand, in N",
      {"run", "outcome", "closed form", "buckles at", "off by", "punctures at",
       "free length at second buckling, mm", "closed form there", "second buckling at", "off by"},
      {}};
  for (const RunRecord& run : group.runs) table.rows.push_back(row_of(run));
  page.table(table);
}

}  // namespace acus::study
