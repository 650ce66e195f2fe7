// Outcomes over two keys: which needles go in straight, which buckle first, which never do; and over them the
// borders that the closed forms draw.
#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "acus/base/decimal.h"
#include "acus/base/units.h"
#include "acus/io/scene_toml.h"
#include "acus/numeric/root.h"
#include "acus/sim/names.h"
#include "acus/sim/prediction.h"
#include "acus/study/exhibits.h"
#include "acus/study/markup.h"

namespace acus::study {
namespace {

struct Look {
  Outcome outcome;
  MarkShape shape;
  int style;
};
constexpr Look looks[] = {{Outcome::straight_puncture, MarkShape::circle, 2},
                          {Outcome::buckled_then_punctured, MarkShape::diamond, 1},
                          {Outcome::never_punctured, MarkShape::cross, 3}};

Look look_of(const std::string& outcome) {
  for (const Look& look : looks) {
    if (name_of(look.outcome) == outcome) return look;
  }
  return looks[2];
}

bool is_number(const std::string& text) {
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  return !text.empty() && *end == '\0' && std::isfinite(value);
}

double chosen_number(const RunRecord& run, const std::string& key) {
  return std::atof(chosen_value(run.chosen, key).c_str());
}

// The different values of a key, ascending.
std::vector<double> values_of(const Panel& panel, const std::string& key) {
  std::vector<double> values;
  for (const RunRecord* run : panel.runs) values.push_back(chosen_number(*run, key));
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
  return values;
}

// How wide a cell may be so that none covers another; 1 for a single value.
double least_step(const std::vector<double>& values) {
  double step = values.size() > 1 ? HUGE_VAL : 1.0;
  for (std::size_t i = 1; i < values.size(); ++i) step = std::min(step, values[i] - values[i - 1]);
  return step;
}

// What it took until the puncture, or in the whole run.
struct Effort {
  double work = 0.0;        // J, of the hand
  double deflection = 0.0;  // m, the largest
};
Effort effort_of(const RunRecord& run) {
  const EventRecord* const puncture = find_event(run, "puncture");
  const auto &time = column(run, "time_s"), &work = column(run, "work_hand_J"),
             &deflection = column(run, "deflection_m");
  Effort effort;
  for (std::size_t row = 0; row < time.size() && (puncture == nullptr || time[row] <= puncture->time);
       ++row) {
    effort.work = work[row];
    effort.deflection = std::max(effort.deflection, deflection[row]);
  }
  return effort;
}

// The keys of the two axes: the first two that vary within a panel.
std::vector<std::string> axes_of(const GroupRecords& group) {
  std::vector<std::string> axes;
  for (const std::string& key : group.group->varied) {
    if (key != group.group->report.panel && axes.size() < 2) axes.push_back(key);
  }
  return axes;
}

struct Axes {
  const std::string &across, &up;
  Point2 size;  // of a cell
  Point2 x_limits, y_limits;
};

// Where a load by the closed forms is the rupture force; `load` grows or falls along `up`.
std::vector<Point2> border(const Scene& scene, const Axes& axes, double Prediction::*load) {
  constexpr int points = 33;
  const auto [low, high] = axes.y_limits;
  std::vector<Point2> line;
  for (int i = 0; i < points; ++i) {
    const double x = axes.x_limits[0] + (axes.x_limits[1] - axes.x_limits[0]) * i / (points - 1);
    bool possible = true;  // scenes outside of what a scene may be have no border
    const auto over = [&](double y) {
      const Result<Scene> there = io::with_settings(
          scene, {joined({axes.across, "=", decimal_text(x)}), joined({axes.up, "=", decimal_text(y)})});
      possible = possible && static_cast<bool>(there);
      return there ? predict(*there).*load - there->contact.rupture_force : 0.0;
    };
    if (over(low) * over(high) >= 0.0 || !possible) continue;
    const double y = numeric::bracketed_root(over, low, high, 1e-3 * (high - low));
    if (possible) line.push_back({x, y});
  }
  return line;
}

Plot map_plot(const GroupRecords& group, const Panel& panel, const Axes& axes) {
  Plot plot;
  plot.title = figure_title(group, panel, "Outcome, and work of the hand in mJ");
  plot.x_label = key_in_words(axes.across);
  plot.y_label = key_in_words(axes.up);
  plot.x_limits = axes.x_limits;
  plot.y_limits = axes.y_limits;
  for (const RunRecord* run : panel.runs) {
    const std::string outcome = summary_text(*run, "/outcome");
    const Look look = look_of(outcome);
    const Effort effort = effort_of(*run);
    const std::string millijoules = number(1e3 * effort.work, 2);
    plot.cells.push_back({{{chosen_number(*run, axes.across), chosen_number(*run, axes.up)},
                           look.shape,
                           look.style,
                           joined({run->chosen.name, ": ", in_words(outcome), ", ", millijoules, " mJ, bow ",
                                   number(effort.deflection / units::mm, 3), " mm"})},
                          axes.size,
                          millijoules});
  }
  for (const Look& look : looks) {
    const std::string name = name_of(look.outcome);
    const auto count = std::count_if(panel.runs.begin(), panel.runs.end(), [&](const RunRecord* run) {
      return summary_text(*run, "/outcome") == name;
    });
    if (count == 0) continue;
    plot.key.push_back({look.shape, in_words(name), joined({"f", std::to_string(look.style)})});
    plot.description += joined({std::to_string(count), " ", in_words(name), ". "});
  }
  const Scene& scene = panel.runs.front()->scene;
  plot.curves.push_back({"Pcr = Fr", 6, border(scene, axes, &Prediction::critical_load), Curve::Dash::solid});
  plot.curves.push_back(
      {"most bowed = Fr", 6, border(scene, axes, &Prediction::highest_load), Curve::Dash::dashed});
  return plot;
}

Table number_table(const Panel& panel) {
  Table table{"Until the puncture, or in all",
              {"run", "outcome", "closed forms", "work of the hand, mJ", "largest deflection, mm"},
              {}};
  for (const RunRecord* run : panel.runs) {
    const Effort effort = effort_of(*run);
    table.rows.push_back({run->chosen.name, in_words(summary_text(*run, "/outcome")),
                          in_words(name_of(predict(run->scene).outcome)), number(1e3 * effort.work, 3),
                          number(effort.deflection / units::mm, 3)});
  }
  return table;
}

// The runs that came out otherwise than the closed forms say, and how near to a border they are.
void say_agreement(Page& page, const GroupRecords& group) {
  Table others{"Cells that came out otherwise",
               {"run", "simulated", "closed forms", "Pcr / Fr", "most when bowed / Fr"},
               {}};
  for (const RunRecord& run : group.runs) {
    const Prediction closed = predict(run.scene);
    const std::string outcome = summary_text(run, "/outcome"), predicted = name_of(closed.outcome);
    if (outcome == predicted) continue;
    const double rupture = run.scene.contact.rupture_force;
    others.rows.push_back({run.chosen.name, in_words(outcome), in_words(predicted),
                           number(closed.critical_load / rupture, 4),
                           number(closed.highest_load / rupture, 4)});
  }
  page.paragraphs(
      joined({std::to_string(group.runs.size() - others.rows.size()), " of ",
              std::to_string(group.runs.size()), " insertions came out as the closed forms say."}));
  if (!others.rows.empty()) page.table(others);
}

}  // namespace

void show_map(Page& page, const GroupRecords& group) {
  const std::vector<std::string> keys = axes_of(group);
  if (keys.size() < 2) return page.note("A map of outcomes needs two keys that vary.");
  for (const RunRecord& run : group.runs) {
    for (const std::string& key : keys) {
      if (!is_number(chosen_value(run.chosen, key)))
        return page.note(joined({"A map of outcomes needs numbers along both axes; ", key, " is not one."}));
    }
  }
  page.begin_row();
  for (const Panel& panel : panels_of(group)) {
    const std::vector<double> xs = values_of(panel, keys[0]), ys = values_of(panel, keys[1]);
    const Point2 size{least_step(xs), least_step(ys)};
    const Axes axes{keys[0],
                    keys[1],
                    size,
                    {xs.front() - size[0] / 2.0, xs.back() + size[0] / 2.0},
                    {ys.front() - size[1] / 2.0, ys.back() + size[1] / 2.0}};
    page.figure(figure_name(group, panel, "map"), drawn(map_plot(group, panel, axes)),
                "What became of each needle; below each mark the work of the hand in mJ until the puncture, "
                "or in all. Solid: where the closed form's critical load is as large as the rupture force. "
                "Dashed: where the most is that the bowed needle carries within the hand's travel.",
                {number_table(panel)});
  }
  page.end_row();
  say_agreement(page, group);
}

}  // namespace acus::study
