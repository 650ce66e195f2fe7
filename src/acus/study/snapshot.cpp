#include "acus/study/snapshot.h"

#include <algorithm>
#include <cmath>

namespace acus::study {
namespace {

constexpr int needle_points = 121;
constexpr double settling_time =
    0.25;  // s after puncture: the tissue has come back up along the shaft by then

Snapshot developed(Moment moment, const Frame& frame, const std::vector<Vec3>& positions,
                   const std::vector<Vec3>& needle, const Simulation& simulation) {
  const mesh::TetMesh& rest = simulation.tissue();
  const CutPlane plane = plane_of_needle(simulation.entry(), simulation.direction(), needle);
  Snapshot shot{moment,
                frame.hand_travel,
                frame.hand_force,
                frame.deflection,
                frame.tip_depth,
                simulation.scene().needle.radius,
                cut_section(positions, rest.tets, plane),
                {},
                {}};
  for (const CutPolygon& polygon : shot.section.polygons) {
    double mean = 0.0;
    for (int node : rest.tets[static_cast<std::size_t>(polygon.tet)]) {
      const auto n = static_cast<std::size_t>(node);
      mean += 0.25 * (positions[n] - rest.nodes[n]).norm();
    }
    shot.displacement.push_back(mean);
  }
  for (const Vec3& x : needle) shot.needle.push_back(on_plane(plane, x));
  return shot;
}

}  // namespace

const char* word(Moment moment) {
  switch (moment) {
    case Moment::rest:
      return "rest";
    case Moment::contact:
      return "contact";
    case Moment::buckled:
      return "buckled";
    case Moment::punctured:
      return "punctured";
    case Moment::second_buckling:
      return "second buckling";
  }
  return "";
}

StageCamera::StageCamera(const Simulation& simulation) { keep(Moment::rest, 0.0, simulation); }

void StageCamera::keep(Moment moment, double merit, const Simulation& simulation) {
  auto place = std::find_if(kept_.begin(), kept_.end(), [&](const Kept& k) { return k.moment == moment; });
  if (place != kept_.end() && place->merit >= merit) return;
  if (place == kept_.end()) place = kept_.insert(place, Kept{moment, {}, {}, {}, merit});
  place->merit = merit;
  place->frame = simulation.frame();
  place->positions.assign(simulation.positions().begin(), simulation.positions().end());
  place->needle = simulation.needle_line(needle_points);
}

void StageCamera::look(const Simulation& simulation) {
  constexpr int steps_between_looks = 10;  // the bow of a needle takes longer to draw than a step to make
  if (looks_++ % steps_between_looks != 0) return;
  // Below this share of the critical load the bow is within ten times the initial one: straight, to the eye.
  constexpr double still_straight = 0.9;
  const Frame& frame = simulation.frame();
  if (frame.health != Health::good) return;  // the state of a step that went wrong need not be finite
  const bool inside = frame.stage == Stage::inserted || frame.stage == Stage::inserted_buckled;
  if (inside && !punctured_at_) punctured_at_ = frame.time;
  if (frame.stage == Stage::contact && !punctured_at_ &&
      frame.hand_force < still_straight * frame.critical_load)
    keep(Moment::contact, frame.tip_force, simulation);
  if (frame.stage == Stage::buckled && !punctured_at_) keep(Moment::buckled, frame.deflection, simulation);
  if (frame.stage == Stage::inserted) {
    straight_inside_ = true;
    // The first settled moment beats every earlier one, and no later one beats it.
    keep(Moment::punctured, std::min(frame.time - *punctured_at_, settling_time), simulation);
  }
  // Right after a puncture the needle is still bowed from before; only a bow that comes after it was straight
  // is a second.
  if (frame.stage == Stage::inserted_buckled && straight_inside_)
    keep(Moment::second_buckling, frame.deflection, simulation);
}

std::vector<Snapshot> StageCamera::snapshots(const Simulation& simulation) const {
  std::vector<Snapshot> shots;
  for (const Kept& k : kept_)
    shots.push_back(developed(k.moment, k.frame, k.positions, k.needle, simulation));
  std::sort(shots.begin(), shots.end(),
            [](const Snapshot& a, const Snapshot& b) { return a.moment < b.moment; });
  return shots;
}

}  // namespace acus::study
