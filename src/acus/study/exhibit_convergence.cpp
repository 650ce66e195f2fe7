// How the force curve depends on the mesh, for each coupling; and Eq. 8 as printed beside ours.
#include <algorithm>
#include <cmath>

#include "acus/base/units.h"
#include "acus/study/curve.h"
#include "acus/study/exhibits.h"
#include "acus/study/markup.h"

namespace acus::study {
namespace {

using units::mm;
constexpr int samples = 200;

long tetrahedra(const RunRecord& run) { return summary_count(run, "/mesh/tetrahedra"); }

// Travel up to the first puncture or buckling, or to where the hand first goes back or ends.
double undisturbed_travel(const RunRecord& run) {
  double travel = way_in(run, "hand_travel_m").back();
  for (const char* event : {"puncture", "buckling"}) {
    if (const EventRecord* found = find_event(run, event)) travel = std::min(travel, found->hand_travel);
  }
  return travel;
}

double common_travel(const Panel& panel) {
  double travel = HUGE_VAL;
  for (const RunRecord* run : panel.runs) travel = std::min(travel, undisturbed_travel(*run));
  return travel;
}

double force_at(const RunRecord& run, double travel) {
  return value_at(way_in(run, "hand_travel_m"), way_in(run, "hand_force_N"), travel);
}

// Root mean square of the difference of two force curves up to `travel`, over that of the second.
double relative_difference(const RunRecord& a, const RunRecord& b, double travel) {
  double off = 0.0, all = 0.0;
  for (int i = 1; i <= samples; ++i) {
    const double x = travel * i / samples, fa = force_at(a, x), fb = force_at(b, x);
    off += (fa - fb) * (fa - fb);
    all += fb * fb;
  }
  return std::sqrt(off / all);
}

Plot curves(const GroupRecords& group, const Panel& panel) {
  Plot plot;
  plot.title = figure_title(group, panel, "Force before puncture");
  plot.description = "One curve for each mesh.";
  plot.x_label = "travel of the hand from first touch, mm";
  plot.y_label = "force on the hand, N";
  for (std::size_t i = 0; i < panel.runs.size(); ++i) {
    const RunRecord& run = *panel.runs[i];
    std::vector<Point2> points;
    for (int k = 0; k <= samples; ++k) {
      const double x = undisturbed_travel(run) * k / samples;
      points.push_back({x / mm, force_at(run, x)});
    }
    plot.curves.push_back(
        {joined({std::to_string(tetrahedra(run)), " tets"}), static_cast<int>(i % 7), points});
  }
  return plot;
}

Table differences(const Panel& panel) {
  const double travel = common_travel(panel);
  Table table{joined({"Up to ", number(travel / mm, 3),
                      " mm of travel (the first mesh to give way ends it): difference of force curves, root "
                      "mean square"}),
              {"mesh, tetrahedra", joined({"force at ", number(travel / mm, 3), " mm, N"}),
               "to the next finer", "to the finest"},
              {}};
  for (std::size_t i = 0; i < panel.runs.size(); ++i) {
    const RunRecord& run = *panel.runs[i];
    const bool finest = i + 1 == panel.runs.size();
    const auto percent = [&](const RunRecord& other) {
      return joined({number(100.0 * relative_difference(run, other, travel), 3), " %"});
    };
    table.rows.push_back({std::to_string(tetrahedra(run)), number(force_at(run, travel)),
                          finest ? "" : percent(*panel.runs[i + 1]),
                          finest ? "" : percent(*panel.runs.back())});
  }
  return table;
}

}  // namespace

void show_convergence(Page& page, const GroupRecords& group) {
  const std::vector<Panel> panels = panels_of(group);
  page.begin_row();
  for (const Panel& panel : panels)
    page.figure(figure_name(group, panel, "convergence"), drawn(curves(group, panel)),
                "The same needle pushed into the same tissue, meshed ever finer.", {});
  page.end_row();
  for (const Panel& panel : panels) {
    if (!panel.value.empty())
      page.heading(3, joined({group.group->name, "-", panel.value}), in_words(panel.value));
    page.table(differences(panel));
  }
}

void show_coupling(Page& page, const GroupRecords& group) {
  Plot plot;
  plot.title = "Eq. 8 as printed, and contact that feels the tissue";
  plot.description =
      "Tip force against depth of the tip: the printed law is a line that knows nothing of the tissue.";
  plot.x_label = "depth of the tip below the undeformed entry, mm";
  plot.y_label = "force at the tip, N";
  const std::vector<Panel> panels = panels_of(group);
  double deepest = 0.0, strongest = 0.0, stiffness = 0.0;
  for (std::size_t i = 0; i < panels.size(); ++i) {
    const RunRecord& run = *panels[i].runs.back();
    const auto travel = way_in(run, "hand_travel_m"), depth = way_in(run, "tip_depth_m"),
               force = way_in(run, "tip_force_N");
    const double end = undisturbed_travel(run);
    std::vector<Point2> points;
    for (std::size_t k = 0; k < travel.size() && travel[k] < end; ++k) {
      points.push_back({depth[k] / mm, force[k]});
      deepest = std::max(deepest, depth[k] / mm);
      strongest = std::max(strongest, force[k]);
    }
    plot.curves.push_back({in_words(panels[i].value), static_cast<int>(i), std::move(points)});
    stiffness = run.scene.contact.stiffness;
  }
  const double printed_depth = strongest / stiffness / mm;
  plot.curves.push_back(
      {joined({"k z, k = ", number(stiffness, 3), " N/m"}), 3, {{0.0, 0.0}, {printed_depth, strongest}}});
  page.figure(joined({group.group->name, "-eq8"}), drawn(plot),
              "Eq. 8 pulls the needle towards where the node was at first, x_e0. Taken as printed the force "
              "is k times the depth, "
              "whatever the tissue does. With the node's present position, as the text of the paper has it, "
              "the tissue decides.",
              {});
}

}  // namespace acus::study
