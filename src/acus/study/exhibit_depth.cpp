// The load at which a needle that is partly inside buckles, over how deep it is, on meshes of several sizes.
#include <algorithm>
#include <cmath>

#include "acus/base/units.h"
#include "acus/sim/support.h"
#include "acus/study/curve.h"
#include "acus/study/exhibits.h"
#include "acus/study/markup.h"

namespace acus::study {
namespace {

using units::mm;

// On one mesh: the depths at which needles under different friction buckled, ascending, and what they
// carried.
struct DepthCurve {
  long tetrahedra = 0;
  std::vector<double> depth, load;  // m, N
};

std::vector<DepthCurve> curves_of(const Panel& panel) {
  std::vector<DepthCurve> curves;
  std::vector<const RunRecord*> runs = panel.runs;
  const auto depth_of = [](const RunRecord* run) {
    const EventRecord* second = find_event(*run, "second_buckling");
    return second == nullptr ? HUGE_VAL : in_front_of_hand(run->scene).length - second->free_length;
  };
  std::stable_sort(runs.begin(), runs.end(),
                   [&](const RunRecord* a, const RunRecord* b) { return depth_of(a) < depth_of(b); });
  for (const RunRecord* run : runs) {
    if (depth_of(run) == HUGE_VAL) continue;
    const long tetrahedra = summary_count(*run, "/mesh/tetrahedra");
    auto curve = std::find_if(curves.begin(), curves.end(),
                              [&](const DepthCurve& c) { return c.tetrahedra == tetrahedra; });
    if (curve == curves.end()) curve = curves.insert(curve, DepthCurve{tetrahedra, {}, {}});
    curve->depth.push_back(depth_of(run));
    curve->load.push_back(find_event(*run, "second_buckling")->hand_force);
  }
  std::sort(curves.begin(), curves.end(),
            [](const DepthCurve& a, const DepthCurve& b) { return a.tetrahedra < b.tetrahedra; });
  return curves;
}

// NaN where no needle buckled so deep, or so near the entry.
double load_at(const DepthCurve& curve, double depth) {
  if (depth < curve.depth.front() || depth > curve.depth.back()) return std::nan("");
  return value_at(curve.depth, curve.load, depth);
}

std::string words_of(const Panel& panel) {
  return panel.runs.front()->scene.contact.near_field ? "with the near field" : "the mesh alone";
}

Plot depth_plot(const Panel& panel) {
  constexpr double deepest = 60.0, heaviest = 2.0;  // mm, N: the same for every panel, to be compared
  Plot plot;
  plot.title = joined({"Second buckling, ", words_of(panel)});
  plot.description = "One curve for each mesh, and the closed form on the free length.";
  plot.x_label = "inserted length, mm";
  plot.y_label = "load, N";
  plot.x_limits = {0.0, deepest};
  plot.y_limits = {0.5, heaviest};
  int style = 0;
  for (const DepthCurve& curve : curves_of(panel)) {
    std::vector<Point2> points;
    for (std::size_t i = 0; i < curve.depth.size(); ++i)
      points.push_back({curve.depth[i] / mm, curve.load[i]});
    plot.curves.push_back({joined({std::to_string(curve.tetrahedra), " tets"}), style++ % 6, points});
  }
  const RunRecord& run = *panel.runs.front();
  std::vector<Point2> closed;
  for (double depth = 0.0; depth <= deepest; depth += 1.0)
    closed.push_back({depth, critical_load(run.scene, in_front_of_hand(run.scene).length - depth * mm)});
  plot.curves.push_back({"closed form", 6, closed, Curve::Dash::dashed});
  return plot;
}

Table depth_table(const Panel& panel) {
  const std::vector<DepthCurve> curves = curves_of(panel);
  Table table{joined({"Load at second buckling, N, ", words_of(panel)}), {"inserted length, mm"}, {}};
  for (const DepthCurve& curve : curves)
    table.head.push_back(joined({std::to_string(curve.tetrahedra), " tets"}));
  table.head.insert(table.head.end(), {"most over least", "closed form on the free length"});
  const RunRecord& run = *panel.runs.front();
  for (const double depth : {10e-3, 20e-3, 30e-3, 45e-3}) {
    std::vector<std::string> row{number(depth / mm)};
    double least = HUGE_VAL, most = 0.0;
    bool whole = true;
    for (const DepthCurve& curve : curves) {
      const double load = load_at(curve, depth);
      row.push_back(number(load, 3));
      least = std::min(least, load), most = std::max(most, load);
      whole = whole && std::isfinite(load);
    }
    row.push_back(whole ? percent_off(most, least) : "-");
    row.push_back(number(critical_load(run.scene, in_front_of_hand(run.scene).length - depth), 3));
    table.rows.push_back(row);
  }
  return table;
}

}  // namespace

void show_depth(Page& page, const GroupRecords& group) {
  const std::vector<Panel> panels = panels_of(group);
  page.begin_row();
  for (const Panel& panel : panels)
    page.figure(figure_name(group, panel, "depth"), drawn(depth_plot(panel)),
                "What the hand carries when the bow outside has come to 5 % of the free length.", {});
  page.end_row();
  for (const Panel& panel : panels) page.table(depth_table(panel));
}

}  // namespace acus::study
