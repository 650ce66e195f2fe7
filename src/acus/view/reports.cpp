#include "acus/view/reports.h"

#include <nlohmann/json.hpp>

#include "acus/io/scene_toml.h"
#include "acus/io/trace_columns.h"
#include "acus/mesh/surface.h"
#include "acus/sim/names.h"
#include "acus/view/offered_scenes.h"

namespace acus::view {
namespace {

using Json = nlohmann::ordered_json;

Json report(const char* type) { return {{"type", type}}; }

// Bytes that are not UTF-8 are replaced.
std::string text_of(const Json& json) { return json.dump(-1, ' ', false, Json::error_handler_t::replace); }

std::string said(const char* type, const std::string& sentence) {
  Json json = report(type);
  json["sentence"] = sentence;
  return text_of(json);
}

void add_expectation(Json& json, const Scene& scene) {
  const Prediction p = predict(scene);
  json["words"] = in_words(scene, p);
  json["outcome"] = name_of(p.outcome);
  json["critical_load_N"] = p.critical_load;
  json["highest_load_N"] = p.highest_load;
  json["rupture_force_N"] = scene.contact.rupture_force;
  json["longest_straight_m"] = p.longest_straight;
}

Json vector(const Vec3& x) { return {x.x(), x.y(), x.z()}; }

// [[a, b, c], ...] one behind the other.
template <class Rows>
Json flat(const Rows& rows) {
  Json list = Json::array();
  for (const auto& row : rows)
    for (const auto& number : row) list.push_back(number);
  return list;
}

}  // namespace

std::string hello_report(const std::string& source, const std::optional<std::string>& device) {
  Json json = report("hello");
  json["engine"] = ACUS_VERSION;
  json["source"] = source;
  json["device"] = device ? Json(*device) : Json();
  json["scenes"] = Json::object();
  for (const OfferedScene& scene : offered_scenes) json["scenes"][scene.name] = scene.toml;
  return text_of(json);
}

std::string model_report(const Simulation& simulation) {
  const Scene& scene = simulation.scene();
  const mesh::TetMesh& mesh = simulation.tissue();
  Json json = report("model");
  json["scene"] = io::scene_json(scene);
  json["scene_toml"] = io::scene_toml(scene);
  json["time_step_s"] = scene.run.time_step;
  json["entry_m"] = vector(simulation.entry());
  json["direction"] = vector(simulation.direction());
  json["needle_length_m"] = scene.needle.length;
  json["needle_radius_m"] = scene.needle.radius;
  json["nodes_m"] = flat(mesh.nodes);
  json["tetrahedra"] = flat(mesh.tets);
  json["triangles"] = flat(mesh::boundary_triangles(mesh));
  add_expectation(json, scene);
  return text_of(json);
}

std::string expectation_report(const Scene& scene) {
  Json json = report("expectation");
  add_expectation(json, scene);
  return text_of(json);
}

std::string event_report(const Event& event) {
  Json json = report("event");
  for (const auto& column : io::event_columns())
    json[column.name] = column.word != nullptr ? Json(column.word(event)) : Json(column.value(event));
  return text_of(json);
}

std::string refused_report(const std::string& sentence) { return said("refused", sentence); }
std::string failed_report(const std::string& sentence) { return said("failed", sentence); }

}  // namespace acus::view
