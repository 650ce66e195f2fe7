// Exhibits: what a report shows of a group of runs. Each writes its part of the page.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "acus/study/page.h"
#include "acus/study/plot.h"
#include "acus/study/results_csv.h"

namespace acus::study {

void show_force(Page& page, const GroupRecords& group);        // Fig. 7: force against travel
void show_energy(Page& page, const GroupRecords& group);       // where the work of the hand went
void show_stages(Page& page, const GroupRecords& group);       // Fig. 6
void show_mesh(Page& page, const GroupRecords& group);         // Fig. 8
void show_loads(Page& page, const GroupRecords& group);        // closed forms against simulated loads
void show_column(Page& page, const GroupRecords& group);       // critical loads and the elastica
void show_shapes(Page& page, const GroupRecords& group);       // Eq. 11 against the elastica
void show_coupling(Page& page, const GroupRecords& group);     // Eq. 8 as printed against ours
void show_convergence(Page& page, const GroupRecords& group);  // force under mesh refinement
void show_exactness(Page& page, const GroupRecords& group);    // force under the solver's tolerance
void show_felt(Page& page, const GroupRecords& group);         // force and travel over time
void show_track(Page& page, const GroupRecords& group);        // where the tip went
void show_map(Page& page, const GroupRecords& group);          // outcome over two keys
void show_depth(Page& page, const GroupRecords& group);        // second buckling over depth, by mesh
// Where the paper contradicts itself, and what these groups of runs do not show.
void show_contradictions(Page& page, const std::vector<GroupRecords>& groups);

// Shared by the exhibits. Each is given runs only that came to their end.

// The runs of one panel: those that agree in the group's panel key.
struct Panel {
  std::string value;  // of that key; empty when there is none
  std::vector<const RunRecord*> runs;
};
std::vector<Panel> panels_of(const GroupRecords& group);

// Whether the hand only ever goes in, and does go in.
bool travel_increases(const RunRecord& run);
// The rows of a column until the hand first goes back: over them the travel does not decrease.
std::span<const double> way_in(const RunRecord& run, const std::string& name);

// "pinned_pinned" as a person says it: "pinned-pinned".
std::string in_words(const std::string& value);
// What a run is called in a legend: the value of the group's curve key with its unit, or the run's name.
std::string curve_name(const GroupRecords& group, const RunRecord& run);
// A key of a scene with its unit, for an axis: "needle length, mm".
std::string key_in_words(const std::string& key);
// "group-panel-exhibit", fit for a file name.
std::string figure_name(const GroupRecords& group, const Panel& panel, const std::string& exhibit);
std::string figure_title(const GroupRecords& group, const Panel& panel, const std::string& words);

// A number in a table: `digits` significant ones; "-" for none.
std::string number(double value, int digits = 4);
// (simulated - predicted) / predicted in percent with its sign.
std::string percent_off(double simulated, double predicted);

// "0.012 %"; what is smaller than anyone cares for is "< 0.001 %".
std::string share(double ratio);

MarkShape shape_of(const std::string& event);

}  // namespace acus::study
