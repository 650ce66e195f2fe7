#include "acus/io/summary_json.h"

#include <nlohmann/json.hpp>

#include "acus/base/hash.h"
#include "acus/io/scene_toml.h"
#include "acus/sim/names.h"
#include "acus/sim/support.h"

namespace acus::io {
namespace {

using Json = nlohmann::ordered_json;

Json predicted_loads(Scene scene) {
  Json loads = Json::object();
  for (needle::Support support : needle::all_supports) {
    scene.needle.support = support;
    loads[name_of(support)] = critical_load(scene);
  }
  return loads;
}

// Each buckling beside the closed form for the free length and support of that moment.
Json bucklings(const Insertion& insertion) {
  Json list = Json::array();
  for (const Event& event : insertion.events)
    if (event.kind == EventKind::buckling || event.kind == EventKind::second_buckling)
      list.push_back({{"event", name_of(event.kind)},
                      {"time_s", event.time},
                      {"hand_travel_m", event.hand_travel},
                      {"free_length_m", event.free_length},
                      {"hand_force_N", event.hand_force},
                      {"predicted_load_N", critical_load(insertion.scene, event.free_length)}});
  return list;
}

Json energy(const Summary& summary) {
  const force::Ledger& l = summary.ledger;
  return {{"work_hand_J", l.work_hand},
          {"energy_tissue_J", l.energy_tissue},
          {"energy_needle_J", l.energy_needle},
          {"energy_contact_J", l.energy_contact},
          {"energy_kinetic_J", l.energy_kinetic},
          {"work_cutting_J", l.work_cutting},
          {"work_friction_J", l.work_friction},
          {"work_damping_J", l.work_damping},
          {"work_numerical_J", l.work_numerical},
          {"work_snap_J", l.work_snap},
          {"work_relaxation_J", l.work_relaxation},
          {"residual_J", force::residual(l)},
          {"peak_work_hand_J", summary.peak_work_hand},
          {"peak_residual_J", summary.peak_energy_residual},
          {"relative_residual", relative_energy_residual(summary)}};
}

}  // namespace

Json versions_json() {
#ifdef __clang__
  const std::string compiler = "clang " __clang_version__;
#else
  const std::string compiler = "g++ " __VERSION__;
#endif
  return {{"acus", ACUS_VERSION},
          {"compiler", compiler},
          {"build_type", ACUS_BUILD_TYPE},
          {"eigen", std::to_string(EIGEN_WORLD_VERSION) + "." + std::to_string(EIGEN_MAJOR_VERSION) + "." +
                        std::to_string(EIGEN_MINOR_VERSION)}};
}

Json summary_json(const Insertion& insertion, std::optional<double> wall_time) {
  const Summary& summary = insertion.summary;
  Json json;
  json["outcome"] = name_of(outcome(insertion.events));
  json["completed"] = !insertion.interrupted && summary.health == Health::good;
  json["health"] = name_of(summary.health);
  json["steps"] = summary.steps;
  json["simulated_time_s"] = summary.time;
  json["peak_hand_force_N"] = summary.peak_hand_force;
  json["peak_hand_force_travel_m"] = summary.peak_hand_force_travel;
  json["peak_tip_force_N"] = summary.peak_tip_force;
  json["rupture_force_N"] = summary.rupture_force ? Json(*summary.rupture_force) : Json();
  json["peak_deflection_m"] = summary.peak_deflection;
  json["peak_tip_depth_m"] = summary.peak_tip_depth;
  json["peak_tip_aside_m"] = summary.peak_tip_aside;
  json["peak_energy_force_gap_N"] = summary.peak_energy_force_gap;
  json["bucklings"] = bucklings(insertion);
  json["predicted_loads_N"] = predicted_loads(insertion.scene);
  json["energy"] = energy(summary);
  json["solver_iterations"] = {{"mean", summary.mean_solver_iterations},
                               {"most", summary.peak_solver_iterations}};
  json["mesh"] = {{"nodes", insertion.nodes}, {"tetrahedra", insertion.tetrahedra}};
  if (wall_time) {
    json["wall_time_s"] = *wall_time;
    json["real_time_factor"] = *wall_time > 0.0 ? summary.time / *wall_time : 0.0;
  }
  json["versions"] = versions_json();
  json["state_hash"] = hex(insertion.state_hash);
  json["scene"] = scene_json(insertion.scene);
  return json;
}

std::string json_text(const Json& json) {
  constexpr int indent = 2;
  return json.dump(indent, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace acus::io
