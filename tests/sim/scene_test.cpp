#include "acus/sim/scene.h"

#include <gtest/gtest.h>

#include <functional>
#include <limits>

#include "acus/sim/scene_keys.h"

namespace acus {
namespace {

TEST(Scene, defaults_are_table_one_of_the_paper_and_make_sense_together) {
  const auto scene = validated(Scene{});
  ASSERT_TRUE(scene) << scene.error().sentence;
  EXPECT_EQ(scene->needle.length, 0.200);
  EXPECT_EQ(scene->needle.radius, 0.0003);
  EXPECT_EQ(scene->needle.youngs_modulus, 200e9);
  EXPECT_EQ(scene->tissue.youngs_modulus, 25e3);
  EXPECT_EQ(scene->tissue.poisson_ratio, 0.48);
  EXPECT_EQ(scene->tissue.density, 1000.0);
}

struct Wrong {
  const char* key;             // the sentence begins with it
  const char* would_be_right;  // and says this
  std::function<void(Scene&)> spoil;
};

TEST(Scene, every_contradiction_is_named_by_its_key) {
  const std::vector<Wrong> wrong = {
      {"tissue.poisson_ratio", "from 0 to 0.4999", [](Scene& s) { s.tissue.poisson_ratio = 0.5; }},
      {"tissue.poisson_ratio", "from 0", [](Scene& s) { s.tissue.poisson_ratio = -0.1; }},
      {"tissue.youngs_modulus_kPa", "from 0.01", [](Scene& s) { s.tissue.youngs_modulus = 0.0; }},
      {"needle.radius_mm", "1/20", [](Scene& s) { s.needle.length = 0.005; }},
      {"needle.imperfection_mm", "1/100", [](Scene& s) { s.needle.imperfection = 0.003; }},
      {"needle.inner_radius_mm", "0.297 mm", [](Scene& s) { s.needle.inner_radius = 0.3e-3; }},
      {"needle.bevel_deg", "from 5 to 90", [](Scene& s) { s.needle.bevel_degrees = 0.1; }},
      {"needle.bevel_deg", "rod",
       [](Scene& s) { s.needle_model = NeedleModel::column, s.needle.bevel_degrees = 20.0; }},
      {"guide.length_mm", "rod",
       [](Scene& s) { s.needle_model = NeedleModel::column, s.guide.length = 10e-3; }},
      {"guide.gap_mm", "in front of the hand", [](Scene& s) { s.guide = {.length = 10e-3, .gap = 0.3}; }},
      {"hand.grip_mm", "20 needle radii", [](Scene& s) { s.hand.grip = s.needle.length - 1e-3; }},
      {"tissue.direction", "[0, 0, -1]", [](Scene& s) { s.tissue.direction.setZero(); }},
      {"tissue.mesh", "remove one", [](Scene& s) { s.tissue.rigid = true, s.tissue.mesh = "liver.msh"; }},
      {"contact.contact_radius_mm", "needle.radius_mm", [](Scene& s) { s.contact.contact_radius = 0.1e-3; }},
      {"contact.contact_radius_mm", "quarter", [](Scene& s) { s.contact.contact_radius = 0.02; }},
      {"hand.travel_mm", "reach at most 197 mm", [](Scene& s) { s.hand.travel = 0.2; }},
      {"hand.path", "hand.kind",
       [](Scene& s) {
         s.hand.path = {{0.0, 0.0}, {1.0, 0.01}};
       }},
      {"hand.path", "at least two points", [](Scene& s) { s.hand.kind = HandKind::path; }},
      {"hand.path", "begin at time 0",
       [](Scene& s) {
         s.hand = {.kind = HandKind::path, .path = {{1.0, 0.0}, {2.0, 0.01}}};
       }},
      {"hand.path", "increasing times",
       [](Scene& s) {
         s.hand = {.kind = HandKind::path, .path = {{0.0, 0.0}, {2.0, 0.01}, {2.0, 0.02}}};
       }},
      {"hand.path", "reach at most 197 mm",
       [](Scene& s) {
         s.hand = {.kind = HandKind::path, .path = {{0.0, 0.0}, {20.0, 0.25}}};
       }},
      {"hand.path", "hand.kind is \"person\"",
       [](Scene& s) {
         s.hand = {.kind = HandKind::person, .path = {{0.0, 0.0}, {1.0, 0.01}}};
       }},
      {"hand.travel_mm", "reach at most 197 mm",
       [](Scene& s) { s.hand = {.kind = HandKind::person, .travel = 0.1969, .path = {}}; }},
      {"hand.force_limit_N", "from 0.01", [](Scene& s) { s.hand.force_limit = 0.0; }},
      {"hand.hesitation_s", "from 0", [](Scene& s) { s.hand.hesitation = -0.1; }},
      {"hand.reaction_s", "from 0", [](Scene& s) { s.hand.reaction = -0.1; }},
      {"hand.tremor_mm", "from 0 to 5", [](Scene& s) { s.hand.tremor = 0.01; }},
      {"hand.seed", "from 0", [](Scene& s) { s.hand.seed = -1; }},
      {"hand.duration_s", "from 0.001", [](Scene& s) { s.hand.duration = 0.0; }},
      // EA / L = 283 kN/m in one step of 1 ms; 3 N may come in fifths of 20 mm/s.
      {"run.time_step_ms", "hand.stiffness_N_m = 30000 or less",
       [](Scene& s) { s.hand.kind = HandKind::person, s.tissue.rigid = true, s.hand.speed = 20e-3; }},
      {"run.time_step_ms", "shorter than the movement",
       [](Scene& s) { s.hand.speed = 10.0, s.hand.travel = 1e-6; }},
      {"run.time_step_ms", "1e+08",
       [](Scene& s) { s.hand = {.speed = 1e-6, .travel = 0.15, .path = {}}, s.run.time_step = 1e-5; }},
      {"run.time_step_ms", "contact.contact_radius_mm", [](Scene& s) { s.hand.speed = 4.0; }},
      {"run.solver_tolerance", "from", [](Scene& s) { s.run.solver_tolerance = 1.0; }},
  };
  for (const Wrong& w : wrong) {
    Scene scene;
    w.spoil(scene);
    const auto checked = validated(scene);
    ASSERT_FALSE(checked) << w.key << " " << w.would_be_right;
    EXPECT_EQ(checked.error().sentence.find(std::string(w.key) + " "), 0U) << checked.error().sentence;
    EXPECT_NE(checked.error().sentence.find(w.would_be_right), std::string::npos) << checked.error().sentence;
  }
}

TEST(Scene, no_number_may_be_nan_or_infinite) {
  for (double poison : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()})
    for (const SceneKey& key : scene_keys()) {
      Scene scene;
      if (const auto* number = std::get_if<NumberField>(&key.field))
        number->of(scene) = poison;
      else if (const auto* vector = std::get_if<VectorField>(&key.field))
        vector->of(scene)[1] = poison;
      else
        continue;
      const auto checked = validated(scene);
      ASSERT_FALSE(checked) << key.name;
      EXPECT_EQ(checked.error().sentence.find(key.name + " "), 0U) << checked.error().sentence;
    }
}

TEST(Scene, direction_comes_out_of_unit_length) {
  Scene scene;
  scene.tissue.direction = {3.0, 0.0, -4.0};
  const auto checked = validated(scene);
  ASSERT_TRUE(checked);
  EXPECT_NEAR((checked->tissue.direction - Vec3(0.6, 0.0, -0.8)).norm(), 0.0, 1e-15);
}

}  // namespace
}  // namespace acus
