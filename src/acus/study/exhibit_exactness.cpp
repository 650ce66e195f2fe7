// How the force depends on what the solver leaves unbalanced, and on the precision of its iterations.
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "acus/base/units.h"
#include "acus/study/exhibits.h"
#include "acus/study/markup.h"

namespace acus::study {
namespace {

using units::mm;
constexpr double least_force = 0.02;  // N: below it a share of the force says nothing

std::string precision_of(const RunRecord& run) {
  return run.scene.run.solver_precision == Precision::double_ ? "double" : "single";
}

// The smallest tolerance, and of those with the same the one in double.
const RunRecord& most_exact(const Panel& panel) {
  return **std::min_element(panel.runs.begin(), panel.runs.end(), [](const RunRecord* a, const RunRecord* b) {
    const RunScene &x = a->scene.run, &y = b->scene.run;
    return x.solver_tolerance != y.solver_tolerance ? x.solver_tolerance < y.solver_tolerance
                                                    : x.solver_precision > y.solver_precision;
  });
}

std::string with_exponent(const char* format, double value) {
  char text[32];
  std::snprintf(text, sizeof text, format, value);
  return text;
}
std::string tolerance_of(const RunRecord& run) {
  return with_exponent("%.3g", run.scene.run.solver_tolerance);
}

struct Deviation {
  double worst = 0.0;        // N
  double worst_share = 0.0;  // of the force
};

// Row by row: the hand goes the same way in all runs.
Deviation deviation(const RunRecord& run, const RunRecord& exact) {
  const std::vector<double>&force = column(run, "hand_force_N"), &other = column(exact, "hand_force_N");
  Deviation d;
  for (std::size_t i = 0; i < std::min(force.size(), other.size()); ++i) {
    const double off = std::abs(force[i] - other[i]), size = std::abs(other[i]);
    d.worst = std::max(d.worst, off);
    if (size > least_force) d.worst_share = std::max(d.worst_share, off / size);
  }
  return d;
}

double mean_iterations(const RunRecord& run) {
  const std::vector<double>& iterations = column(run, "solver_iterations");
  double sum = 0.0;
  for (const double n : iterations) sum += n;
  return iterations.empty() ? 0.0 : sum / static_cast<double>(iterations.size());
}

Table deviations(const Panel& panel) {
  const RunRecord& exact = most_exact(panel);
  Table table{joined({"Deviation from the run with a tolerance of ", tolerance_of(exact), " in ",
                      precision_of(exact), " precision, the largest at any row of the trace"}),
              {"run", "tolerance", "precision", "force on the hand, N", "of the force, where above 0.02 N",
               "iterations a step"},
              {}};
  for (const RunRecord* run : panel.runs) {
    const Deviation d = deviation(*run, exact);
    const bool itself = run == &exact;
    if (column(*run, "hand_travel_m") !=
        column(exact, "hand_travel_m")) {  // what is missing may be the worst
      table.rows.push_back(
          {run->chosen.name, tolerance_of(*run), precision_of(*run), "the hand goes another way", "", ""});
      continue;
    }
    table.rows.push_back({run->chosen.name, tolerance_of(*run), precision_of(*run),
                          itself ? "" : with_exponent("%.1e", d.worst), itself ? "" : share(d.worst_share),
                          number(mean_iterations(*run), 3)});
  }
  return table;
}

Plot curves(const GroupRecords& group, const Panel& panel) {
  const RunRecord& exact = most_exact(panel);
  Plot plot;
  plot.title = figure_title(group, panel, "Force on the hand");
  plot.description = "One curve for each tolerance, in single precision.";
  plot.x_label = "travel of the hand from first touch, mm";
  plot.y_label = "off the most exact run, mN";
  int style = 0;
  for (const RunRecord* run : panel.runs) {
    if (run->scene.run.solver_precision == Precision::double_) continue;
    const std::vector<double>&travel = column(*run, "hand_travel_m"), &force = column(*run, "hand_force_N"),
          &other = column(exact, "hand_force_N");
    std::vector<Point2> points;
    for (std::size_t i = 0; i < std::min(force.size(), other.size()); ++i)
      points.push_back({travel[i] / mm, 1e3 * (force[i] - other[i])});
    plot.curves.push_back({tolerance_of(*run), style++ % 7, std::move(points)});
  }
  return plot;
}

}  // namespace

void show_exactness(Page& page, const GroupRecords& group) {
  const std::vector<Panel> panels = panels_of(group);
  page.begin_row();
  for (const Panel& panel : panels)
    page.figure(figure_name(group, panel, "exactness"), drawn(curves(group, panel)),
                "The same push, solved ever more roughly.", {});
  page.end_row();
  for (const Panel& panel : panels) {
    page.heading(3, joined({group.group->name, "-exactness-", panel.value}),
                 figure_title(group, panel, "Deviations"));
    page.table(deviations(panel));
  }
}

}  // namespace acus::study
