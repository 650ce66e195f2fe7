// The paper's Fig. 7: the reaction force against the hand's travel, with its events and the closed forms as
// levels.
#include <algorithm>
#include <cmath>
#include <set>

#include "acus/base/units.h"
#include "acus/sim/support.h"
#include "acus/study/curve.h"
#include "acus/study/exhibits.h"
#include "acus/study/markup.h"

namespace acus::study {
namespace {

using units::mm;
constexpr std::size_t most_named_curves = 7;  // beyond, names cover each other and all curves look alike

std::vector<Point2> force_curve(const RunRecord& run) {
  const auto &travel = column(run, "hand_travel_m"), &force = column(run, "hand_force_N");
  std::vector<Point2> points;
  for (std::size_t i = 0; i < travel.size(); ++i) points.push_back({travel[i] / mm, force[i]});
  return points;
}

void add_marks(Plot& plot, const RunRecord& run, int style, const std::string& name,
               std::set<std::string>& kinds) {
  for (const EventRecord& event : run.events) {
    kinds.insert(event.event);
    plot.marks.push_back({{event.hand_travel / mm, event.hand_force},
                          shape_of(event.event),
                          style,
                          joined({name, ": ", in_words(event.event), " at ",
                                  number(event.hand_travel / mm, 4), " mm, ", number(event.hand_force, 4),
                                  " N, free length ", number(event.free_length / mm, 4), " mm"})});
  }
}

// One level for each different critical load and rupture force.
void add_levels(Plot& plot, const Panel& panel) {
  std::set<std::string> drawn;
  for (std::size_t i = 0; i < panel.runs.size(); ++i) {
    const double load = critical_load(panel.runs[i]->scene);
    const std::string label = joined({"closed form ", number(load, 3), " N"});
    if (drawn.insert(label).second) plot.levels.push_back({load, static_cast<int>(i), label});
  }
  for (const RunRecord* run : panel.runs) {
    const std::string label = joined({"rupture ", number(run->scene.contact.rupture_force, 3), " N"});
    if (drawn.insert(label).second) plot.levels.push_back({run->scene.contact.rupture_force, 6, label});
  }
}

// The forces at even steps of the travel; of the time where a hand goes back, for then a travel comes more
// than once.
Table force_table(const GroupRecords& group, const Panel& panel) {
  constexpr int rows = 24;
  const bool by_travel = std::all_of(panel.runs.begin(), panel.runs.end(),
                                     [](const RunRecord* run) { return travel_increases(*run); });
  const char* const along = by_travel ? "hand_travel_m" : "time_s";
  Table table{
      joined({"Reaction force in N at the hub against the ", by_travel ? "travel of the hand" : "time"}),
      {by_travel ? "travel, mm" : "time, s"},
      {}};
  double furthest = 0.0;
  for (const RunRecord* run : panel.runs) {
    table.head.push_back(curve_name(group, *run));
    furthest = std::max(furthest, column(*run, along).back());
  }
  for (int i = 0; i <= rows; ++i) {
    const double place = furthest * i / rows;
    std::vector<std::string> row{number(by_travel ? place / mm : place, 4)};
    for (const RunRecord* run : panel.runs) {
      const auto& places = column(*run, along);
      row.push_back(place > places.back() * (1.0 + 1e-9)
                        ? "-"
                        : number(value_at(places, column(*run, "hand_force_N"), place)));
    }
    table.rows.push_back(std::move(row));
  }
  return table;
}

Table event_table(const GroupRecords& group, const Panel& panel) {
  Table table{
      "Events", {"needle", "event", "travel, mm", "force, N", "free length, mm", "closed form there, N"}, {}};
  for (const RunRecord* run : panel.runs) {
    for (const EventRecord& event : run->events)
      table.rows.push_back({curve_name(group, *run), in_words(event.event), number(event.hand_travel / mm),
                            number(event.hand_force), number(event.free_length / mm),
                            number(critical_load(run->scene, event.free_length))});
  }
  return table;
}

Plot force_plot(const GroupRecords& group, const Panel& panel) {
  Plot plot;
  plot.title = figure_title(group, panel, "Reaction force");
  plot.x_label = "travel of the hand from first touch, mm";
  plot.y_label = "force on the hand, N";
  std::set<std::string> kinds;
  const bool named = panel.runs.size() <= most_named_curves;
  for (std::size_t i = 0; i < panel.runs.size(); ++i) {
    const int style = named ? static_cast<int>(i) : 0;
    const std::string name = curve_name(group, *panel.runs[i]);
    plot.curves.push_back({named ? name : "", style, force_curve(*panel.runs[i])});
    if (named) add_marks(plot, *panel.runs[i], style, name, kinds);
    plot.description +=
        joined({i == 0 ? "" : "; ", name, ": ", in_words(summary_text(*panel.runs[i], "/outcome"))});
  }
  if (named) add_levels(plot, panel);
  for (const char* event :
       {"contact", "buckling", "straightening", "puncture", "second_buckling", "layer", "exit"}) {
    if (kinds.count(event) > 0) plot.key.push_back({shape_of(event), in_words(event)});
  }
  return plot;
}

}  // namespace

void show_force(Page& page, const GroupRecords& group) {
  const std::vector<Panel> panels = panels_of(group);
  page.begin_row();
  for (const Panel& panel : panels) {
    page.figure(figure_name(group, panel, "force"), drawn(force_plot(group, panel)),
                "Force that the hand feels. Dotted levels: the closed form's critical load on the needle's "
                "full length, in "
                "the colour of its curve, and the rupture force.",
                {force_table(group, panel), event_table(group, panel)});
  }
  page.end_row();
}

}  // namespace acus::study
