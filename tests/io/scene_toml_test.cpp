#include "acus/io/scene_toml.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "acus/sim/scene_keys.h"

namespace acus::io {
namespace {

Scene read(const std::string& text) {
  auto scene = parse_scene(text, "scene.toml");
  EXPECT_TRUE(scene) << (scene ? "" : scene.error().sentence);
  return scene ? *scene : Scene{};
}

std::string refusal(const std::string& text, const std::vector<std::string>& settings = {}) {
  const auto scene = parse_scene(text, "scene.toml", settings);
  return scene ? "accepted" : scene.error().sentence;
}

// toml++ recurses over the parts of a dotted key; half a million of them would exhaust the stack.
TEST(SceneToml, keys_of_very_many_parts_are_refused_with_their_line) {
  std::string deep = "a";
  for (int i = 0; i < 400'000; ++i) deep += ".a";
  for (const std::string& text : {"[" + deep + "]\n", deep + " = 1\n", "x = {" + deep + " = 1}\n",
                                  "x = [{" + deep + " = 1}]\n", "[[" + deep + "]]\n"})
    EXPECT_EQ(refusal("\n" + text).find("scene.toml:2: a key has more than 16 parts"), 0U);
}

TEST(SceneToml, dots_within_text_numbers_and_comments_make_no_deep_key) {
  const std::string dots(100, '.');
  EXPECT_NE(refusal("[tissue]\nmesh = \"" + dots + "\"  # " + dots + "\n"), "");
  for (const std::string& text : {"mesh = \"" + dots + "\\\"" + dots + "\"", "mesh = '" + dots + "'",
                                  "mesh = \"\"\"" + dots + "\n" + dots + "\"\"\"", "# " + dots})
    EXPECT_EQ(refusal("[tissue]\n" + text + "\n").find("parts"), std::string::npos) << text;
}

TEST(SceneToml, numbers_arrive_in_si_as_the_doubles_of_their_literals) {
  const Scene scene = read(R"(
    [needle]
    length_mm = 150
    radius_mm = 0.7
    youngs_modulus_GPa = 70.5
    support = "pinned_pinned"
    [tissue]
    size_mm = [80, 90.5, 40]
    element = "linear"
    [hand]
    kind = "path"
    path = [[0, 0], [2, 35.1], [3.5, -2]]
    [run]
    time_step_ms = 2
  )");
  EXPECT_EQ(scene.needle.length, 0.15);
  EXPECT_EQ(scene.needle.radius, 0.7e-3);
  EXPECT_EQ(scene.needle.youngs_modulus, 70.5e9);
  EXPECT_EQ(scene.needle.support, needle::Support::pinned_pinned);
  EXPECT_EQ(scene.tissue.size, Vec3(0.08, 0.0905, 0.04));
  EXPECT_EQ(scene.tissue.element, Element::linear);
  ASSERT_EQ(scene.hand.path.size(), 3U);
  EXPECT_EQ(scene.hand.path[1].travel, 35.1e-3);
  EXPECT_EQ(scene.hand.path[2].travel, -2e-3);
  EXPECT_EQ(scene.run.time_step, 0.002);
}

TEST(SceneToml, every_choice_is_spelt_as_its_enumerator) {
  EXPECT_EQ(read("tissue.element = 'nodal_pressure'").tissue.element, Element::nodal_pressure);
  EXPECT_EQ(read("contact.crack = 'slit'").contact.crack, Crack::slit);
  EXPECT_EQ(read("contact.crack = 'ring'").contact.crack, Crack::ring);
  EXPECT_EQ(read("contact.coupling = 'nearest_node'").contact.coupling, Coupling::nearest_node);
  EXPECT_EQ(read("contact.coupling = 'embedded'").contact.coupling, Coupling::embedded);
  EXPECT_EQ(read("needle.support = 'clamped_free'").needle.support, needle::Support::clamped_free);
  EXPECT_EQ(read("needle.support = 'clamped_clamped'").needle.support, needle::Support::clamped_clamped);
  EXPECT_EQ(read("needle.support = 'clamped_pinned'").needle.support, needle::Support::clamped_pinned);
}

TEST(SceneToml, an_empty_scene_is_the_default_scene) { EXPECT_EQ(scene_toml(read("")), scene_toml(Scene{})); }

TEST(SceneToml, a_mesh_is_looked_for_beside_its_scene) {
  const auto scene = parse_scene("tissue.mesh = 'meshes/liver.msh'", "/somewhere/scenes/a.toml");
  ASSERT_TRUE(scene);
  EXPECT_EQ(scene->tissue.mesh, "/somewhere/scenes/meshes/liver.msh");
}

TEST(SceneToml, settings_lie_over_the_file) {
  const auto scene =
      parse_scene("[needle]\nlength_mm = 150", "a.toml",
                  {"needle.length_mm=300", "needle.support=pinned_pinned", "tissue.size_mm=[1e2, 90, 80]",
                   "hand.speed_mm_s=5", "contact.crack=\"slit\""});
  ASSERT_TRUE(scene) << scene.error().sentence;
  EXPECT_EQ(scene->needle.length, 0.3);
  EXPECT_EQ(scene->needle.support, needle::Support::pinned_pinned);
  EXPECT_EQ(scene->tissue.size, Vec3(0.1, 0.09, 0.08));
  EXPECT_EQ(scene->contact.crack, Crack::slit);
}

TEST(SceneToml, errors_point_at_line_and_column) {
  EXPECT_EQ(refusal("[needle]\n  length_mm = \"long\"\n")
                .find("scene.toml:2:15: needle.length_mm must be a number"),
            0U);
  EXPECT_EQ(
      refusal("[needle]\nlength_mm = 150\n[hand]\ntravel_mm = 180\n").find("scene.toml:4:13: hand.travel_mm"),
      0U);
  EXPECT_EQ(
      refusal("", {"hand.travel_mm=300"}).find("--set hand.travel_mm=300: hand.travel_mm must leave 10"), 0U);
}

// Scenes that TOML can express: numbers of up to fifteen digits in the unit of their key, inside its range.
rc::Gen<double> number_in(Range range) {
  return rc::gen::map(
      rc::gen::pair(rc::gen::inRange<long long>(0, 1'000'000'000'001), rc::gen::inRange(0, 13)),
      [range](const std::pair<long long, int>& draw) {
        const double share = static_cast<double>(draw.first) / 1e12;
        std::ostringstream digits;
        digits.precision(3 + draw.second);
        digits << range.least + share * (range.most - range.least);
        const double value = std::strtod(digits.str().c_str(), nullptr);
        const bool inside = value >= range.least && value < range.most;
        return inside ? value : range.least;
      });
}

struct DrawField {
  std::ostringstream& toml;

  void operator()(const NumberField& f) const { toml << *number_in(f.range); }
  void operator()(const IntegerField& f) const { toml << std::floor(*number_in(f.range)); }
  void operator()(const SwitchField&) const { toml << (*rc::gen::arbitrary<bool>() ? "true" : "false"); }
  void operator()(const ChoiceField& f) const { toml << '"' << *rc::gen::elementOf(f.names) << '"'; }
  void operator()(const FileField&) const { toml << R"("a \"b\" \\ \t ü.msh")"; }
  void operator()(const VectorField& f) const {
    toml << '[' << *number_in(f.range) << ',' << *number_in(f.range) << ',' << *number_in(f.range) << ']';
  }
  void operator()(const HandPathField& f) const {
    toml << "[[0, " << *number_in(f.travel) << "], [" << *number_in(f.time) << ", " << *number_in(f.travel)
         << "]]";
  }
};

// A text of some keys with values of their own.
std::string drawn_scene() {
  std::ostringstream toml;
  toml.precision(17);
  for (const SceneKey& key : scene_keys())
    if (*rc::gen::inRange(0, 4) == 0) {
      toml << key.name << " = ";
      std::visit(DrawField{toml}, key.field);
      toml << "\n";
    }
  return toml.str();
}

TEST(SceneToml, writing_and_reading_back_gives_the_same_scene) {
  const bool held = rc::check([] {
    // Few draws make sense together: one of a hundred should.
    auto scene = parse_scene(drawn_scene(), "a.toml");
    for (int draw = 1; draw < 100 && !scene.ok(); ++draw) scene = parse_scene(drawn_scene(), "a.toml");
    RC_PRE(scene.ok());
    const auto again = parse_scene(scene_toml(*scene), "a.toml");
    RC_ASSERT(again.ok());
    RC_ASSERT(scene_json(*again) == scene_json(*scene));
    Scene one = *scene, two = *again;
    for (const SceneKey& key : scene_keys())
      if (const auto* number = std::get_if<NumberField>(&key.field))
        RC_ASSERT(number->of(one) == number->of(two));
      else if (const auto* vector = std::get_if<VectorField>(&key.field))
        RC_ASSERT(vector->of(one) == vector->of(two));
  });
  EXPECT_TRUE(held);
}

TEST(SceneToml, no_text_makes_the_reader_crash) {
  const bool held = rc::check([](const std::string& noise) { (void)parse_scene(noise, "noise.toml"); });
  EXPECT_TRUE(held);
  for (const char* text : {"[?", "[", "a", "=", "\xff\xfe", "a \u00a1 = 1", "\u00e9 = 1", "a = \u2fff",
                           "a = \ufb01", "[[needle]]", "needle = 1", "[needle.length_mm]", "a.b.c.d = 1",
                           "\"\" = 1", "[needle]\n\"length_mm\\u0000\" = 1"})
    EXPECT_NE(refusal(text), "accepted") << text;
  EXPECT_NE(refusal(std::string(100000, '[')), "accepted");
  EXPECT_NE(refusal("a = " + std::string(100000, '[')), "accepted");
}

std::string shipped(const char* file) {
  std::ifstream stream(std::string(ACUS_SOURCE_DIR) + file);
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

TEST(SceneToml, the_shipped_reference_of_keys_is_the_generated_one) {
  EXPECT_EQ(shipped("/docs/scene-keys.md"), scene_keys_page())
      << "write it anew: acus check --keys > docs/scene-keys.md";
}

TEST(SceneToml, the_page_has_the_gauges_and_materials_of_the_engine) {
  EXPECT_EQ(shipped("/studio/src/state/needles.json"), needles_json())
      << "write it anew: acus check --needles > studio/src/state/needles.json";
}

// ISO 9626: the outer diameter of 0.7 mm tubing is 0.698 to 0.730 mm, of 0.5 mm tubing 0.500 to 0.530 mm.
TEST(SceneToml, a_gauge_and_a_material_stand_for_their_numbers) {
  const auto scene = parse_scene("[needle]\ngauge = \"22G\"\nmaterial = \"nitinol\"", "a.toml");
  ASSERT_TRUE(scene.ok()) << scene.error().sentence;
  EXPECT_GE(2e3 * scene->needle.radius, 0.698);
  EXPECT_LE(2e3 * scene->needle.radius, 0.730);
  EXPECT_EQ(scene_json(*scene)["needle"]["radius_mm"], 0.3588);
  EXPECT_EQ(scene_json(*scene)["needle"]["inner_radius_mm"], 0.2065);
  EXPECT_EQ(scene_json(*scene)["needle"]["youngs_modulus_GPa"], 75);
  EXPECT_EQ(scene_json(*scene)["needle"]["density_kg_m3"], 6450);
  EXPECT_FALSE(scene_json(*scene)["needle"].contains("gauge"));
  // Laid over, either goes before what the scene has.
  const auto thinner = with_settings(*scene, {"needle.gauge=25G"});
  ASSERT_TRUE(thinner.ok()) << thinner.error().sentence;
  EXPECT_GE(2e3 * thinner->needle.radius, 0.500);
  EXPECT_LE(2e3 * thinner->needle.radius, 0.530);
  const auto solid = with_settings(*scene, {"needle.inner_radius_mm=0"});
  ASSERT_TRUE(solid.ok()) << solid.error().sentence;
  EXPECT_EQ(solid->needle.inner_radius, 0.0);
  EXPECT_EQ(solid->needle.radius, scene->needle.radius);
}

TEST(SceneToml, a_gauge_beside_a_radius_is_refused_in_one_sentence) {
  const std::string both = "needle.gauge sets needle.radius_mm, which is given too; remove one of the two";
  EXPECT_EQ(refusal("[needle]\ngauge = \"22G\"\nradius_mm = 0.3"), "scene.toml:3:13: " + both);
  const auto set = with_settings(Scene{}, {"needle.radius_mm=0.3", "needle.gauge=22G"});
  ASSERT_FALSE(set.ok());
  EXPECT_EQ(set.error().sentence, "--set needle.gauge=22G: " + both);
  EXPECT_NE(refusal("[needle]\ngauge = \"22\"").find("did you mean \"22G\"?"), std::string::npos);
  EXPECT_NE(refusal("[needle]\ngauge = 22").find("but is 22"), std::string::npos);
  EXPECT_NE(refusal("[needle]\nguage = \"22G\"").find("did you mean needle.gauge?"), std::string::npos);
}

}  // namespace
}  // namespace acus::io
