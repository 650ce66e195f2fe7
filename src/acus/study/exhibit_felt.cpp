// What the hand feels and does as time goes on: for hands that stop, go back, or are a person's.
#include <algorithm>
#include <set>

#include "acus/base/units.h"
#include "acus/study/curve.h"
#include "acus/study/exhibits.h"
#include "acus/study/markup.h"

namespace acus::study {
namespace {

using units::mm;

// One column of every run over time, with the events upon it.
Plot over_time(const GroupRecords& group, const Panel& panel, const std::string& name, double unit) {
  Plot plot;
  plot.x_label = "time, s";
  std::set<std::string> kinds;
  for (std::size_t i = 0; i < panel.runs.size(); ++i) {
    const RunRecord& run = *panel.runs[i];
    const auto &time = column(run, "time_s"), &values = column(run, name);
    const int style = static_cast<int>(i);
    std::vector<Point2> points;
    for (std::size_t row = 0; row < time.size(); ++row) points.push_back({time[row], values[row] / unit});
    plot.curves.push_back({curve_name(group, run), style, std::move(points)});
    for (const EventRecord& event : run.events) {
      kinds.insert(event.event);
      plot.marks.push_back({{event.time, value_at(time, values, event.time) / unit},
                            shape_of(event.event),
                            style,
                            joined({curve_name(group, run), ": ", in_words(event.event), " at ",
                                    number(event.time), " s, ", number(event.hand_force), " N"})});
    }
  }
  for (const std::string& event : kinds) plot.key.push_back({shape_of(event), in_words(event)});
  return plot;
}

// How far the tip goes on before a person can react to the puncture. m
double overshoot(const RunRecord& run, const EventRecord& puncture) {
  const auto &time = column(run, "time_s"), &depth = column(run, "tip_depth_m");
  return value_at(time, depth, std::min(puncture.time + run.scene.hand.reaction, time.back())) -
         value_at(time, depth, puncture.time);
}

Table felt_table(const GroupRecords& group) {
  Table table{
      "What each hand felt. Overshoot: what the tip went on by after the puncture until a person could "
      "react.",
      {"run", "outcome", "buckled after, s", "under, N", "punctured after, s", "under, N", "overshoot, mm",
       "peak force, N", "took, s"},
      {}};
  for (const RunRecord& run : group.runs) {
    std::vector<std::string> row{run.chosen.name, in_words(summary_text(run, "/outcome"))};
    const EventRecord* const puncture = find_event(run, "puncture");
    for (const EventRecord* event : {find_event(run, "buckling"), puncture}) {
      row.push_back(event == nullptr ? "-" : number(event->time, 3));
      row.push_back(event == nullptr ? "-" : number(event->hand_force, 3));
    }
    row.push_back(puncture == nullptr ? "-" : number(overshoot(run, *puncture) / mm, 3));
    row.push_back(number(summary_number(run, "/peak_hand_force_N"), 3));
    row.push_back(number(summary_number(run, "/simulated_time_s"), 3));
    table.rows.push_back(std::move(row));
  }
  return table;
}

}  // namespace

void show_felt(Page& page, const GroupRecords& group) {
  for (const Panel& panel : panels_of(group)) {
    page.begin_row();
    Plot force = over_time(group, panel, "hand_force_N", 1.0);
    force.title = figure_title(group, panel, "Felt force");
    force.y_label = "force on the hand, N";
    force.description = "The force on the hand over time, one curve a run.";
    page.figure(figure_name(group, panel, "felt"), drawn(force), "The force that the hand feels, over time.",
                {});
    Plot travel = over_time(group, panel, "hand_travel_m", mm);
    travel.title = figure_title(group, panel, "Travel of the hub");
    travel.y_label = "travel from first touch, mm";
    travel.description = "The travel of the needle's hub over time, one curve a run.";
    page.figure(figure_name(group, panel, "travel"), drawn(travel),
                "Where the hand has brought the needle's hub, over time.", {});
    page.end_row();
  }
  page.table(felt_table(group));
}

}  // namespace acus::study
