// The bare column in a testing machine: critical loads against closed forms, post-buckling against the
// elastica.
#include <cmath>

#include "acus/sim/names.h"
#include "acus/sim/support.h"
#include "acus/study/curve.h"
#include "acus/study/elastica_table.h"
#include "acus/study/exhibits.h"
#include "acus/study/markup.h"

namespace acus::study {
namespace {

// What a run in the testing machine gives at an end shortening: hub travel / length. The axial compression of
// the steel (P / EA, 1e-5 of the length) is left in.
struct Measured {
  double load_ratio, bow_ratio;
};

Measured measured(const RunRecord& run, double shortening_ratio) {
  const double length = run.scene.needle.length;
  const auto travel = way_in(run, "hand_travel_m");
  return {value_at(travel, way_in(run, "hand_force_N"), shortening_ratio * length) / critical_load(run.scene),
          value_at(travel, way_in(run, "deflection_m"), shortening_ratio * length) / length};
}

std::vector<Point2> ratio_curve(const RunRecord& run, const char* name, double unit) {
  const auto &travel = column(run, "hand_travel_m"), &values = column(run, name);
  std::vector<Point2> points;
  for (std::size_t i = 0; i < travel.size(); ++i)
    points.push_back({100.0 * travel[i] / run.scene.needle.length, values[i] / unit});
  return points;
}

Plot ratio_plot(const GroupRecords& group, const std::string& title, const std::string& y_label,
                const char* name, bool load) {
  Plot plot;
  plot.title = title;
  plot.x_label = "end shortening, % of the length";
  plot.y_label = y_label;
  plot.description = "Curves: simulated. Marks: the elastica by independent shooting.";
  plot.key = {{MarkShape::circle, "elastica, independent solution"}};
  if (load) plot.y_limits = Point2{0.95, 1.25};  // below, all rise alike from nothing
  for (std::size_t i = 0; i < group.runs.size(); ++i) {
    const RunRecord& run = group.runs[i];
    const double unit = load ? critical_load(run.scene) : run.scene.needle.length;
    const int style = static_cast<int>(i % 7);
    plot.curves.push_back({in_words(name_of(run.scene.needle.support)), style, ratio_curve(run, name, unit)});
    for (const ElasticaRow& row : elastica_table(run.scene.needle.support)) {
      plot.marks.push_back(
          {{100.0 * row.shortening_ratio, load ? row.load_ratio : row.bow_ratio},
           MarkShape::circle,
           style,
           joined({in_words(name_of(run.scene.needle.support)), ", ", number(100.0 * row.shortening_ratio),
                   " %: ", number(load ? row.load_ratio : row.bow_ratio)})});
    }
  }
  return plot;
}

Table critical_table(const GroupRecords& group) {
  Table table{"Critical load of the bare column, N", {"support", "closed form", "simulated", "off by"}, {}};
  for (const RunRecord& run : group.runs) {
    const double predicted = critical_load(run.scene);
    const EventRecord* event = find_event(run, "buckling");
    table.rows.push_back({in_words(name_of(run.scene.needle.support)), number(predicted),
                          event == nullptr ? "none" : number(event->hand_force),
                          event == nullptr ? "" : percent_off(event->hand_force, predicted)});
  }
  return table;
}

Table elastica_rows(const GroupRecords& group) {
  Table table{
      "After buckling: load over critical load and largest deflection over length, simulated and by "
      "independent shooting",
      {"support", "end shortening", "load, elastica", "simulated", "off by", "bow, elastica", "simulated",
       "off by"},
      {}};
  for (const RunRecord& run : group.runs) {
    const double furthest = way_in(run, "hand_travel_m").back() / run.scene.needle.length;
    for (const ElasticaRow& row : elastica_table(run.scene.needle.support)) {
      if (row.shortening_ratio < 0.01 || row.shortening_ratio > furthest * (1.0 + 1e-9)) continue;
      const Measured m = measured(run, row.shortening_ratio);
      table.rows.push_back(
          {in_words(name_of(run.scene.needle.support)), joined({number(100.0 * row.shortening_ratio), " %"}),
           number(row.load_ratio, 5), number(m.load_ratio, 5), percent_off(m.load_ratio, row.load_ratio),
           number(row.bow_ratio), number(m.bow_ratio), percent_off(m.bow_ratio, row.bow_ratio)});
    }
  }
  return table;
}

}  // namespace

void show_column(Page& page, const GroupRecords& group) {
  page.table(critical_table(group));
  page.begin_row();
  page.figure(joined({group.group->name, "-load"}),
              drawn(ratio_plot(group, "Load after buckling", "load / critical load", "hand_force_N", true)),
              "Load of the bare column against how much closer its ends have come. Marks: elastica. At small "
              "bows the load is lower by "
              "the share that the needle's initial bow has in it.",
              {});
  page.figure(
      joined({group.group->name, "-bow"}),
      drawn(ratio_plot(group, "Bow after buckling", "largest deflection / length", "deflection_m", false)),
      "Bow of the bare column; for clamped-free the deflection of the tip.", {});
  page.end_row();
  page.table(elastica_rows(group));
}

}  // namespace acus::study
