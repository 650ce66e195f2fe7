// The ledger: where the work of the hand has gone.
#include <algorithm>
#include <cmath>

#include "acus/base/units.h"
#include "acus/study/exhibits.h"
#include "acus/study/markup.h"

namespace acus::study {
namespace {

using units::mm;
constexpr double mJ = 1e-3;
constexpr std::size_t points_of_a_band = 240;

struct Line {
  const char* column;
  const char* words;
  int style;
};
constexpr Line lines[] = {
    {"energy_tissue_J", "tissue, elastic", 0},  {"energy_needle_J", "needle, elastic", 1},
    {"energy_contact_J", "contact springs", 4}, {"energy_kinetic_J", "kinetic", 6},
    {"work_cutting_J", "cutting", 2},           {"work_friction_J", "friction", 3},
    {"work_damping_J", "damping", 5},           {"work_snap_J", "snaps", 7},
    {"work_relaxation_J", "relaxation", 4},     {"work_numerical_J", "integrator", 6}};

StackPlot energy_plot(const GroupRecords& group, const Panel& panel, const RunRecord& run) {
  StackPlot plot;
  plot.title = figure_title(group, panel, "Energy");
  if (panel.runs.size() > 1) plot.title.append(", ").append(curve_name(group, run));
  plot.x_label = "travel of the hand from first touch, mm";
  plot.y_label = "energy, mJ";
  const auto &travel = column(run, "hand_travel_m"), &work = column(run, "work_hand_J");
  double peak = 0.0;
  for (double w : work) peak = std::max(peak, std::abs(w));
  const std::size_t stride = std::max<std::size_t>(1, travel.size() / points_of_a_band);
  std::vector<std::size_t> rows;
  for (std::size_t i = 0; i < travel.size(); i += stride) rows.push_back(i);
  if (rows.back() + 1 != travel.size()) rows.push_back(travel.size() - 1);
  for (std::size_t i : rows)
    plot.x.push_back(travel[i] / mm), plot.total.points.push_back({travel[i] / mm, work[i] / mJ});
  constexpr double invisible =
      0.003;  // of the work of the hand: a band too thin to see only clutters the labels
  for (const Line& line : lines) {
    const auto& values = column(run, line.column);
    const double most = std::abs(*std::max_element(
        values.begin(), values.end(), [](double a, double b) { return std::abs(a) < std::abs(b); }));
    if (most < invisible * peak) continue;
    Band band{line.words, line.style, {}};
    for (std::size_t i : rows) band.values.push_back(values[i] / mJ);
    plot.bands.push_back(std::move(band));
  }
  plot.total.label = "work of the hand";
  plot.description = "Stacked: where the work of the hand went. The line on top is the work itself.";
  return plot;
}

const RunRecord* most_eventful(const Panel& panel) {
  return *std::max_element(panel.runs.begin(), panel.runs.end(), [](const RunRecord* a, const RunRecord* b) {
    return a->events.size() < b->events.size();
  });
}

Table ledger_table(const GroupRecords& group) {
  Table table{
      "The ledger at the end of each run, mJ. Residual: the largest at any time, over the largest work of "
      "the hand. "
      "Force gap: the largest difference between the energy force (Eq. 14-18 with the signs mended) and the "
      "reaction "
      "at the hub, over the peak force.",
      {"run", "work of hand"},
      {}};
  for (const Line& line : lines) table.head.push_back(line.words);
  table.head.insert(table.head.end(), {"residual", "force gap"});
  for (const RunRecord& run : group.runs) {
    const double work = column(run, "work_hand_J").back();
    std::vector<std::string> row{run.chosen.name, number(work / mJ)};
    constexpr double negligible = 1e-5;  // of the work: more digits would only be noise
    for (const Line& line : lines) {
      const double value = column(run, line.column).back();
      row.push_back(std::abs(value) < negligible * std::abs(work) ? "0" : number(value / mJ, 3));
    }
    row.push_back(share(summary_number(run, "/energy/relative_residual")));
    row.push_back(
        share(summary_number(run, "/peak_energy_force_gap_N") / summary_number(run, "/peak_hand_force_N")));
    table.rows.push_back(std::move(row));
  }
  return table;
}

}  // namespace

void show_energy(Page& page, const GroupRecords& group) {
  page.begin_row();
  std::string left_out;
  for (const Panel& panel : panels_of(group)) {
    const RunRecord& run = *most_eventful(panel);
    if (!travel_increases(run)) {
      left_out += joined({left_out.empty() ? "" : ", ", run.chosen.name});
      continue;
    }
    page.figure(figure_name(group, panel, "energy"), drawn(energy_plot(group, panel, run)),
                "Where the work of the hand went, stacked; the black line is that work. Lines below 0.3 % "
                "are left out.",
                {});
  }
  page.end_row();
  if (!left_out.empty())
    page.note(
        joined({"No picture of the energy over the travel, since the hand goes back: ", left_out, "."}));
  page.table(ledger_table(group));
}

}  // namespace acus::study
