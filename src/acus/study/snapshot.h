// Snapshots: what the needle and the tissue look like at the moments of an insertion that are worth a
// picture.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "acus/base/result.h"
#include "acus/sim/simulation.h"
#include "acus/study/section.h"

namespace acus::study {

// The paper's four pictures (Fig. 6), and the mesh before anything moves (Fig. 8).
enum class Moment { rest, contact, buckled, punctured, second_buckling };
const char* word(Moment moment);  // "second buckling"

struct Snapshot {
  Moment moment = Moment::rest;
  double hand_travel = 0.0;          // m
  double hand_force = 0.0;           // N
  double deflection = 0.0;           // m
  double tip_depth = 0.0;            // m
  double needle_radius = 0.0;        // m
  Section section;                   // m, in the plane of the needle, origin at the undeformed entry
  std::vector<double> displacement;  // m, mean of each polygon's tetrahedron
  std::vector<Point2> needle;        // m, hub to tip
};

// Watches an insertion step by step and keeps the state at each moment's best: contact where the tip pushes
// hardest while the needle is straight, buckled and second_buckling where the bow is largest, punctured once
// it has settled.
class StageCamera {
 public:
  explicit StageCamera(const Simulation& simulation);
  void look(const Simulation& simulation);
  // Those that came about, in order of moments. Cutting the sections happens here.
  std::vector<Snapshot> snapshots(const Simulation& simulation) const;

 private:
  struct Kept {
    Moment moment;
    Frame frame;
    std::vector<Vec3> positions;
    std::vector<Vec3> needle;
    double merit;
  };
  void keep(Moment moment, double merit, const Simulation& simulation);

  std::vector<Kept> kept_;
  std::optional<double> punctured_at_;  // s
  int looks_ = 0;
  bool straight_inside_ = false;  // since then
};

// Lengths are written in micrometres as whole numbers, which no picture can tell from the truth. A snapshot
// that cannot be drawn (of numbers that are not finite) is left out; in JSON it is an Error.
nlohmann::json to_json(const std::vector<Snapshot>& snapshots);
Result<std::vector<Snapshot>> snapshots_from_json(const nlohmann::json& json);

}  // namespace acus::study
