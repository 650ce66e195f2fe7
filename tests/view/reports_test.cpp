#include "acus/view/reports.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "acus/io/scene_toml.h"
#include "acus/mesh/surface.h"
#include "tests/view/small_scene.h"

namespace acus::view {
namespace {

using Json = nlohmann::json;

Scene scene(const std::vector<std::string>& settings = {}) {
  return *io::parse_scene(small_scene, "scene", settings);
}

// Those of docs/studio-protocol.md, and no others.
void expect_members(const Json& report, const std::string& type, std::set<std::string> members) {
  EXPECT_EQ(report.at("type"), type);
  members.insert("type");
  std::set<std::string> found;
  for (const auto& [name, value] : report.items()) found.insert(name);
  EXPECT_EQ(found, members);
}

const std::set<std::string> of_expectation = {"words",          "outcome",         "critical_load_N",
                                              "highest_load_N", "rupture_force_N", "longest_straight_m"};

TEST(Reports, hello_says_what_runs_and_brings_scenes_that_make_sense) {
  const Json hello = Json::parse(hello_report("serve", "Falcon"));
  expect_members(hello, "hello", {"engine", "source", "device", "scenes"});
  EXPECT_EQ(hello["source"], "serve");
  EXPECT_EQ(hello["device"], "Falcon");
  EXPECT_TRUE(Json::parse(hello_report("wasm", std::nullopt))["device"].is_null());
  EXPECT_GE(hello["scenes"].size(), 4U);
  for (const auto& [name, toml] : hello["scenes"].items()) {
    const auto offered = io::parse_scene(toml.get<std::string>(), name);
    EXPECT_TRUE(offered.ok()) << offered.error().sentence;
    const auto file = io::read_scene(ACUS_SOURCE_DIR "/scenes/" + name + ".toml");
    EXPECT_EQ(io::scene_toml(*offered), io::scene_toml(*file)) << name;
  }
}

TEST(Reports, model_carries_scene_mesh_and_expectation) {
  const auto simulation = Simulation::build(scene());
  const Json model = Json::parse(model_report(*simulation));
  std::set<std::string> members = {"scene",     "scene_toml", "time_step_s",     "entry_m",
                                   "direction", "nodes_m",    "needle_length_m", "needle_radius_m",
                                   "triangles", "tetrahedra"};
  members.insert(of_expectation.begin(), of_expectation.end());
  expect_members(model, "model", members);
  const mesh::TetMesh& mesh = simulation->tissue();
  ASSERT_EQ(model["nodes_m"].size(), 3 * mesh.nodes.size());
  ASSERT_EQ(model["tetrahedra"].size(), 4 * mesh.tets.size());
  EXPECT_EQ(model["nodes_m"][3 * 7 + 2], mesh.nodes[7].z());
  EXPECT_EQ(model["tetrahedra"][4 * 5 + 1], mesh.tets[5][1]);
  // The surface closes around the block: its outward triangles hold the block's volume.
  const auto corner = [&](std::size_t k) { return mesh.nodes[model["triangles"][k].get<std::size_t>()]; };
  double volume = 0.0;
  for (std::size_t k = 0; k < model["triangles"].size(); k += 3)
    volume += corner(k).dot(corner(k + 1).cross(corner(k + 2))) / 6.0;
  EXPECT_NEAR(volume, 0.1 * 0.1 * 0.06, 1e-12);
  EXPECT_EQ(model["entry_m"], Json({0.0, 0.0, 0.06}));
  EXPECT_EQ(model["direction"], Json({0.0, 0.0, -1.0}));
  EXPECT_EQ(model["scene"]["contact"]["rupture_force_N"], 0.65);
  EXPECT_EQ(io::scene_toml(*io::parse_scene(model["scene_toml"].get<std::string>(), "scene")),
            io::scene_toml(scene()));
}

TEST(Reports, bare_column_is_a_model_without_tissue) {
  const auto simulation = Simulation::build(scene({"tissue.rigid=true"}));
  const Json model = Json::parse(model_report(*simulation));
  EXPECT_TRUE(model["nodes_m"].is_array() && model["nodes_m"].empty());
  EXPECT_TRUE(model["triangles"].empty());
}

TEST(Reports, expectation_says_in_words_what_the_closed_forms_predict) {
  const std::pair<std::vector<std::string>, const char*> cases[] = {
      {{"contact.rupture_force_N=1"}, "will not go in"},
      {{"contact.rupture_force_N=0.65"}, "go in all the same"},
      {{"contact.rupture_force_N=0.5"}, "go in straight"},
      {{"contact.rupture_force_N=0.5", "hand.travel_mm=1"}, "does not go far enough"},
      {{"tissue.rigid=true"}, "against a fixed stop"},
  };
  for (const auto& [settings, part] : cases) {
    const Json said = Json::parse(expectation_report(scene(settings)));
    expect_members(said, "expectation", of_expectation);
    const std::string words = said["words"];
    EXPECT_NE(words.find(part), std::string::npos) << words;
    // Euler: 0.642 N for this needle.
    if (settings.size() == 1) EXPECT_NE(words.find("buckles at 0.642 N"), std::string::npos) << words;
    EXPECT_NEAR(said["critical_load_N"].get<double>(), 0.642, 1e-3);
  }
}

TEST(Reports, events_and_sentences_keep_their_members_and_any_text) {
  const Json event = Json::parse(event_report({1.5, EventKind::second_buckling, 0.03, 0.7, 0.17}));
  expect_members(event, "event", {"time_s", "event", "hand_travel_m", "hand_force_N", "free_length_m"});
  EXPECT_EQ(event["event"], "second_buckling");
  EXPECT_EQ(event["hand_force_N"], 0.7);
  expect_members(Json::parse(refused_report("a \"b\"\n\xff")), "refused", {"sentence"});
  expect_members(Json::parse(failed_report("gone")), "failed", {"sentence"});
  EXPECT_EQ(Json::parse(refused_report("a \"b\"\n"))["sentence"], "a \"b\"\n");
}

}  // namespace
}  // namespace acus::view
