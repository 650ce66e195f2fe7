// Writing a frame allocates nothing. This program counts every operator new.
#include <gtest/gtest.h>

#include "acus/io/scene_toml.h"
#include "acus/view/frame_bytes.h"
#include "tests/counted_allocations.h"
#include "tests/view/small_scene.h"

namespace acus::view {
namespace {

TEST(FrameAllocation, is_none_before_and_after_the_puncture) {
  auto simulation =
      Simulation::build(*io::parse_scene(small_scene, "scene", {"contact.rupture_force_N=0.5"}));
  ASSERT_TRUE(simulation.ok());
  FrameScratch scratch = build_frame_scratch(*simulation);
  std::vector<std::byte> bytes(frame_size(*simulation));
  for (int step = 1; step <= 150; ++step) {
    simulation->step(2e-4 * step);
    const long before = allocations;
    frame_into(bytes, *simulation, scratch);
    ASSERT_EQ(allocations, before) << "step " << step;
  }
  EXPECT_GT(simulation->frame().inserted_length, 1e-3);
}

}  // namespace
}  // namespace acus::view
