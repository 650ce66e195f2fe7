// Outcomes over two keys: which needles go in straight, which buckle first, which never do.
#include <cmath>
#include <cstdlib>
#include <map>

#include "acus/study/exhibits.h"
#include "acus/study/markup.h"

namespace acus::study {
namespace {

struct Look {
  MarkShape shape;
  int style;
};

Look look_of(const std::string& outcome) {
  if (outcome == "straight_puncture") return {MarkShape::circle, 2};
  if (outcome == "buckled_then_punctured") return {MarkShape::diamond, 1};
  return {MarkShape::cross, 3};
}

bool is_number(const std::string& text) {
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  return !text.empty() && *end == '\0' && std::isfinite(value);
}

}  // namespace

void show_map(Page& page, const GroupRecords& group) {
  if (group.group->varied.size() < 2) {
    page.note("A map of outcomes needs two keys that vary.");
    return;
  }
  const std::string &across = group.group->varied[0], &up = group.group->varied[1];
  for (const RunRecord& run : group.runs) {
    for (const std::string* key : {&across, &up}) {
      if (!is_number(chosen_value(run.chosen, *key)))
        return page.note(joined({"A map of outcomes needs numbers along both axes; ", *key, " is not one."}));
    }
  }
  Plot plot;
  plot.title = "Outcome of each insertion";
  plot.x_label = across;
  plot.y_label = up;
  plot.description = "One mark a run.";
  std::map<std::string, int> counts;
  for (const RunRecord& run : group.runs) {
    const std::string outcome = summary_text(run, "/outcome");
    const Look look = look_of(outcome);
    const double x = std::atof(chosen_value(run.chosen, across).c_str()),
                 y = std::atof(chosen_value(run.chosen, up).c_str());
    plot.marks.push_back(
        {{x, y}, look.shape, look.style, joined({run.chosen.name, ": ", in_words(outcome)})});
    if (counts[outcome]++ == 0) plot.key.push_back({look.shape, in_words(outcome)});
  }
  page.figure(joined({group.group->name, "-map"}), drawn(plot), "What became of each needle.", {});
}

}  // namespace acus::study
