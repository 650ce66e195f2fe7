#include "acus/study/exhibits.h"

#include <algorithm>
#include <cmath>

#include "acus/io/scene_toml.h"
#include "acus/study/axis_ticks.h"
#include "acus/study/markup.h"
#include "acus/study/text_hash.h"

namespace acus::study {
namespace {

// The unit that a key ends with: needle.length_mm -> " mm"; units with a slash are written without.
std::string unit_of(const std::string& key) {
  for (const char* unit : {"mm", "GPa", "kPa", "N", "ms", "mm_s"}) {
    if (key.ends_with(joined({"_", unit})))
      return joined({" ", std::string_view(unit) == "mm_s" ? "mm/s" : unit});
  }
  return {};
}

}  // namespace

std::vector<Panel> panels_of(const GroupRecords& group) {
  std::vector<Panel> panels;
  for (const RunRecord& run : group.runs) {
    const std::string value = chosen_value(run.chosen, group.group->report.panel);
    auto panel = std::find_if(panels.begin(), panels.end(), [&](const Panel& p) { return p.value == value; });
    if (panel == panels.end()) panel = panels.insert(panel, Panel{value, {}});
    panel->runs.push_back(&run);
  }
  return panels;
}

bool travel_increases(const RunRecord& run) {
  const auto& travel = column(run, "hand_travel_m");
  return std::is_sorted(travel.begin(), travel.end()) && travel.front() < travel.back();
}

std::span<const double> way_in(const RunRecord& run, const std::string& name) {
  const auto& travel = column(run, "hand_travel_m");
  const auto back = std::is_sorted_until(travel.begin(), travel.end());
  return std::span(column(run, name)).first(static_cast<std::size_t>(back - travel.begin()));
}

std::string in_words(const std::string& value) {
  std::string words = value;
  std::replace(words.begin(), words.end(), '_', value == "nearest_node" ? ' ' : '-');
  return words;
}

std::string curve_name(const GroupRecords& group, const RunRecord& run) {
  const std::string& key = group.group->report.curve;
  const std::string value = chosen_value(run.chosen, key);
  if (value.empty()) return in_words(run.chosen.name);
  const std::string what = key == "tissue.tetrahedra" ? " tets" : unit_of(key);
  return in_words(value) + what;
}

std::string key_in_words(const std::string& key) {
  const std::string unit = unit_of(key);
  std::string words = key.substr(0, key.size() - unit.size());
  for (char& letter : words) {
    if (letter == '.' || letter == '_') letter = ' ';
  }
  return unit.empty() ? words : joined({words, ",", unit});
}

std::string figure_name(const GroupRecords& group, const Panel& panel, const std::string& exhibit) {
  std::string name = group.group->name;
  if (!panel.value.empty()) {
    constexpr std::size_t longest = 100;  // letters: with the name of the study still a name of a file
    std::string part = name_part({"", io::toml_string(panel.value)});
    // Two values may come to the same letters: what was changed is told apart by its hash.
    if (part != panel.value || part.size() > longest)
      part = joined({part.substr(0, longest), "-", hex(hash_of_text(panel.value))});
    name.append("-").append(part);
  }
  return name.append("-").append(exhibit);
}

std::string figure_title(const GroupRecords& group, const Panel& panel, const std::string& words) {
  if (panel.value.empty()) return words;
  const std::string& key = group.group->report.panel;
  return joined({words, ", ", in_words(panel.value), unit_of(key)});
}

std::string number(double value, int digits) {
  return std::isfinite(value) ? short_number(value, digits) : "-";
}

std::string percent_off(double simulated, double predicted) {
  const double percent = 100.0 * (simulated - predicted) / predicted;
  if (!std::isfinite(percent)) return "-";
  const std::string text = tick_label(percent, std::abs(percent) < 1.0 ? 0.01 : 0.1);
  return joined({text[0] == '-' ? "" : "+", text, " %"});
}

std::string share(double ratio) {
  constexpr double negligible = 1e-5;
  if (!std::isfinite(ratio)) return "-";
  return ratio < negligible ? "< 0.001 %" : joined({number(100.0 * ratio, 2), " %"});
}

MarkShape shape_of(const std::string& event) {
  if (event == "buckling") return MarkShape::triangle_down;
  if (event == "straightening") return MarkShape::square;
  if (event == "puncture") return MarkShape::diamond;
  if (event == "second_buckling") return MarkShape::triangle_up;
  if (event == "contact") return MarkShape::circle;
  return MarkShape::cross;
}

}  // namespace acus::study
