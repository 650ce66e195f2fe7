// The threads that keep time record without allocating. This program counts every operator new.
#include <gtest/gtest.h>

#include <filesystem>

#include "acus/haptics/recorder.h"
#include "acus/io/replay.h"
#include "tests/counted_allocations.h"

namespace acus::haptics {
namespace {

// With room, without room, and after the disk was given up.
TEST(RecorderAllocation, is_none_in_a_step_or_a_tick) {
  const std::string path = ::testing::TempDir() + "acus_recorder_allocation_test";
  std::filesystem::remove(path);
  auto recorder = Recorder::start(path, *io::recorded_scene(Scene{}), "--record", {64, 64});
  ASSERT_TRUE(recorder) << recorder.error().sentence;
  const long before = allocations;
  for (int i = 0; i < 100'000; ++i) {
    const bool due = (*recorder)->hash_due();
    (*recorder)->step(1e-6 * i, due ? std::optional<std::uint64_t>(7) : std::nullopt);
    (*recorder)->tick({});
  }
  EXPECT_EQ(allocations, before);
  EXPECT_TRUE((*recorder)->finish(1));
  std::filesystem::remove(path);
}

}  // namespace
}  // namespace acus::haptics
