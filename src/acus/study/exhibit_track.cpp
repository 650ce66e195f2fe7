// Where the tip went, and how near to a circle: for needles that steer.
#include "acus/base/units.h"
#include "acus/study/curve.h"
#include "acus/study/exhibits.h"
#include "acus/study/markup.h"

namespace acus::study {
namespace {

using units::mm;

// m: depth and distance from the straight path, since the tip went in and until the hand first goes back.
std::vector<Point2> track(const RunRecord& run) {
  const auto inside = way_in(run, "inserted_length_m"), depth = way_in(run, "tip_depth_m"),
             aside = way_in(run, "tip_aside_m");
  std::vector<Point2> points;
  for (std::size_t row = 0; row < inside.size(); ++row)
    if (inside[row] > 0.0) points.push_back({depth[row], aside[row]});
  return points;
}

// The last of it: at first the needle is led by the hand more than by what it has cut.
std::vector<Point2> steered(const std::vector<Point2>& track) {
  constexpr double led = 10e-3;  // m
  std::vector<Point2> points;
  for (const Point2& p : track)
    if (p[0] > led) points.push_back(p);
  return points;
}

Plot tracks(const GroupRecords& group, const Panel& panel) {
  Plot plot;
  plot.title = figure_title(group, panel, "Track of the tip");
  plot.description = "How far the tip is from the straight path over its depth, one curve a run.";
  plot.x_label = "depth, mm";
  plot.y_label = "aside, mm";
  for (std::size_t i = 0; i < panel.runs.size(); ++i) {
    std::vector<Point2> points = track(*panel.runs[i]);
    for (Point2& p : points) p = {p[0] / mm, p[1] / mm};
    plot.curves.push_back({curve_name(group, *panel.runs[i]), static_cast<int>(i), std::move(points)});
  }
  return plot;
}

Table track_table(const GroupRecords& group) {
  Table table{
      "How far each tip went aside, and the circle through its track below 10 mm; off the circle: root mean "
      "square.",
      {"run", "outcome", "depth, mm", "aside, mm", "curvature, 1/m", "off the circle, mm"},
      {}};
  for (const RunRecord& run : group.runs) {
    std::vector<std::string> row{run.chosen.name, in_words(summary_text(run, "/outcome"))};
    const std::vector<Point2> whole = track(run), part = steered(whole);
    row.push_back(whole.empty() ? "-" : number(whole.back()[0] / mm, 3));
    row.push_back(whole.empty() ? "-" : number(whole.back()[1] / mm, 3));
    const std::optional<Circle> circle = circle_through(part);
    row.push_back(circle ? number(circle->curvature, 3) : "-");
    row.push_back(circle ? number(circle->residual / mm, 2) : "-");
    table.rows.push_back(std::move(row));
  }
  return table;
}

}  // namespace

void show_track(Page& page, const GroupRecords& group) {
  for (const Panel& panel : panels_of(group))
    page.figure(figure_name(group, panel, "track"), drawn(tracks(group, panel)),
                "Where the tip went: its distance from the straight path over its depth.", {});
  page.table(track_table(group));
}

}  // namespace acus::study
