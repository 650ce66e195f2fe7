// Snapshots as JSON, beside the trace of their run.
#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <nlohmann/json.hpp>

#include "acus/study/snapshot.h"

namespace acus::study {
namespace {

constexpr double micrometre = 1e-6;

constexpr double furthest = 1e6;  // m: nothing that can be drawn is further away

long whole(double metres) { return std::lround(metres / micrometre); }

bool drawable(double value) { return std::abs(value) < furthest; }  // false for NaN
bool drawable(const Point2& p) { return drawable(p[0]) && drawable(p[1]); }

bool drawable(const CutPolygon& polygon) {
  for (int i = 0; i < polygon.corners; ++i) {
    if (!drawable(polygon.corner[static_cast<std::size_t>(i)])) return false;
  }
  return true;
}

bool drawable(const Snapshot& shot) {
  const auto all = [](const auto& list) {
    return std::all_of(list.begin(), list.end(), [](const auto& one) { return drawable(one); });
  };
  const std::initializer_list<double> numbers{shot.hand_travel, shot.hand_force, shot.deflection,
                                              shot.tip_depth, shot.needle_radius};
  return all(numbers) && all(shot.section.polygons) && all(shot.displacement) && all(shot.needle) &&
         std::all_of(shot.section.outline.begin(), shot.section.outline.end(),
                     [](const auto& piece) { return drawable(piece[0]) && drawable(piece[1]); });
}

void append(nlohmann::json& list, const Point2& p) {
  list.push_back(whole(p[0]));
  list.push_back(whole(p[1]));
}

nlohmann::json to_json(const Snapshot& shot) {
  auto polygons = nlohmann::json::array(), outline = nlohmann::json::array(),
       needle = nlohmann::json::array();
  auto displacement = nlohmann::json::array();
  for (const CutPolygon& polygon : shot.section.polygons) {
    auto corners = nlohmann::json::array();
    for (int i = 0; i < polygon.corners; ++i) append(corners, polygon.corner[static_cast<std::size_t>(i)]);
    polygons.push_back(corners);
  }
  for (double d : shot.displacement) displacement.push_back(whole(d));
  for (const auto& piece : shot.section.outline) append(outline, piece[0]), append(outline, piece[1]);
  for (const Point2& p : shot.needle) append(needle, p);
  return {{"moment", static_cast<int>(shot.moment)},
          {"hand_travel_m", shot.hand_travel},
          {"hand_force_N", shot.hand_force},
          {"deflection_m", shot.deflection},
          {"tip_depth_m", shot.tip_depth},
          {"needle_radius_m", shot.needle_radius},
          {"polygons_um", polygons},
          {"displacement_um", displacement},
          {"outline_um", outline},
          {"needle_um", needle}};
}

std::vector<Point2> points(const nlohmann::json& list) {
  std::vector<Point2> out;
  for (std::size_t i = 0; i + 1 < list.size(); i += 2)
    out.push_back({list[i].get<double>() * micrometre, list[i + 1].get<double>() * micrometre});
  return out;
}

Snapshot one_from_json(const nlohmann::json& json) {
  Snapshot shot;
  shot.moment = static_cast<Moment>(json.at("moment").get<int>());
  shot.hand_travel = json.at("hand_travel_m").get<double>();
  shot.hand_force = json.at("hand_force_N").get<double>();
  shot.deflection = json.at("deflection_m").get<double>();
  shot.tip_depth = json.at("tip_depth_m").get<double>();
  shot.needle_radius = json.at("needle_radius_m").get<double>();
  for (const auto& corners : json.at("polygons_um")) {
    const std::vector<Point2> around = points(corners);
    CutPolygon polygon{0, around.size() <= 4 ? static_cast<int>(around.size()) : 0, {}};
    for (std::size_t i = 0; i < static_cast<std::size_t>(polygon.corners); ++i) polygon.corner[i] = around[i];
    shot.section.polygons.push_back(polygon);
  }
  for (const auto& d : json.at("displacement_um")) shot.displacement.push_back(d.get<double>() * micrometre);
  const std::vector<Point2> ends = points(json.at("outline_um"));
  for (std::size_t i = 0; i + 1 < ends.size(); i += 2) shot.section.outline.push_back({ends[i], ends[i + 1]});
  shot.needle = points(json.at("needle_um"));
  return shot;
}

// Whether it is such as to_json() writes, whatever stood in the file.
bool sound(const Snapshot& shot) {
  const auto& polygons = shot.section.polygons;
  return shot.moment >= Moment::rest && shot.moment <= Moment::second_buckling && drawable(shot) &&
         shot.displacement.size() == polygons.size() && shot.needle.size() >= 2 &&
         std::all_of(polygons.begin(), polygons.end(), [](const CutPolygon& p) { return p.corners >= 3; });
}

}  // namespace

nlohmann::json to_json(const std::vector<Snapshot>& snapshots) {
  auto list = nlohmann::json::array();
  for (const Snapshot& shot : snapshots) {
    if (drawable(shot)) list.push_back(to_json(shot));
  }
  return list;
}

Result<std::vector<Snapshot>> snapshots_from_json(const nlohmann::json& json) {
  if (!json.is_array()) return Error{"must be a list of snapshots"};
  std::vector<Snapshot> shots;
  try {
    for (const auto& one : json) {
      shots.push_back(one_from_json(one));
      if (!sound(shots.back())) return Error{"holds a snapshot that cannot be drawn"};
    }
  } catch (const nlohmann::json::exception& wrong) {
    return Error{std::string("holds no snapshots that can be read: ") + wrong.what()};
  }
  return shots;
}

}  // namespace acus::study
