// What a probe hears of a step: every part, and nothing that would change it.
#include "acus/sim/step_probe.h"

#include <gtest/gtest.h>

#include <array>
#include <set>
#include <string>

#include "acus/sim/names.h"
#include "acus/sim/simulation.h"

namespace acus {
namespace {

struct Heard {
  std::array<int, step_parts> times{};
  StepProbe probe() {
    return {[](void* self, StepPart part) { ++static_cast<Heard*>(self)->times[static_cast<int>(part)]; },
            this};
  }
};

class StepProbeOf : public ::testing::TestWithParam<NeedleModel> {};
INSTANTIATE_TEST_SUITE_P(, StepProbeOf, ::testing::Values(NeedleModel::column, NeedleModel::rod));

TEST_P(StepProbeOf, a_needle_hears_every_part_and_changes_no_bit) {
  Scene scene;
  scene.needle_model = GetParam();
  scene.tissue.tetrahedra = 600;
  scene.contact.rupture_force = 0.1;  // N
  Simulation heard = Simulation::build(scene).value(), alone = Simulation::build(scene).value();
  Heard all;
  heard.set_probe(all.probe());
  constexpr int steps = 100;
  constexpr double stride = 0.1e-3;  // m
  for (int i = 1; i <= steps; ++i) {
    heard.step(stride * i);
    alone.step(stride * i);
  }
  ASSERT_EQ(heard.frame().health, Health::good);
  EXPECT_EQ(heard.frame().stage, Stage::inserted);
  for (int part = 0; part < step_parts; ++part)
    EXPECT_GE(all.times[part], steps) << name_of(static_cast<StepPart>(part));
  EXPECT_EQ(heard.state_hash(), alone.state_hash());
}

TEST(StepParts, have_names_of_their_own) {
  std::set<std::string> names;
  for (int part = 0; part < step_parts; ++part) names.insert(name_of(static_cast<StepPart>(part)));
  EXPECT_EQ(names.size(), static_cast<std::size_t>(step_parts));
}

}  // namespace
}  // namespace acus
