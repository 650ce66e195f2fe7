// The paper's Fig. 6 (the stages of an insertion) and Fig. 8 (the mesh refined along the path).
#include <algorithm>

#include "acus/base/units.h"
#include "acus/study/exhibits.h"
#include "acus/study/markup.h"
#include "acus/study/stage_drawing.h"

namespace acus::study {
namespace {

using units::mm;

std::vector<Snapshot> stages(const RunRecord& run) {
  std::vector<Snapshot> shots;
  for (const Snapshot& shot : run.snapshots) {
    if (shot.moment != Moment::rest) shots.push_back(shot);
  }
  return shots;
}

Table stage_table(const std::vector<Snapshot>& shots) {
  Table table{"", {"stage", "travel, mm", "force on the hand, N", "depth of the tip, mm", "bow, mm"}, {}};
  for (const Snapshot& shot : shots)
    table.rows.push_back({word(shot.moment), number(shot.hand_travel / mm), number(shot.hand_force),
                          number(shot.tip_depth / mm), number(shot.deflection / mm)});
  return table;
}

}  // namespace

void show_stages(Page& page, const GroupRecords& group) {
  for (const Panel& panel : panels_of(group)) {
    const RunRecord& run = **std::max_element(
        panel.runs.begin(), panel.runs.end(),
        [](const RunRecord* a, const RunRecord* b) { return a->snapshots.size() < b->snapshots.size(); });
    const std::vector<Snapshot> shots = stages(run);
    if (shots.empty()) continue;
    std::string description = "Sections of tissue and needle:";
    for (const Snapshot& shot : shots)
      description += joined({" ", word(shot.moment), " at ", number(shot.hand_travel / mm, 3), " mm and ",
                             number(shot.hand_force, 3), " N;"});
    page.figure(figure_name(group, panel, "stages"),
                stage_drawing(shots, figure_title(group, panel, "The stages of an insertion"), description),
                "The tissue cut through the needle's axis, deformed to scale and shaded by its displacement; "
                "the needle to "
                "true thickness. Below, the entry close up. The arrow is the force of the hand on the hub.",
                {stage_table(shots)});
  }
}

void show_mesh(Page& page, const GroupRecords& group) {
  for (const RunRecord& run : group.runs) {
    const Snapshot* rest = find_snapshot(run, Moment::rest);
    if (rest == nullptr || rest->section.polygons.empty()) continue;
    const auto count = static_cast<int>(summary_count(run, "/mesh/tetrahedra"));
    page.figure(
        joined({group.group->name, "-mesh"}), mesh_drawing(*rest, count, "The mesh, refined along the path"),
        joined({"Section through the axis of insertion before anything moves (the paper's Fig. 8): ",
                std::to_string(count), " tetrahedra, subdivided in advance where the needle will go."}),
        {});
    return;
  }
}

}  // namespace acus::study
