// The threads that keep time record without allocating. This program counts every operator new.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <new>

#include "acus/haptics/recorder.h"
#include "acus/io/replay.h"

namespace {
thread_local long allocations = 0;  // of this thread: the recorder's own may allocate
}

// Not inlined, lest the compiler see a free for a new and warn of it.
[[gnu::noinline]] void* operator new(std::size_t size) {
  ++allocations;
  if (void* memory = std::malloc(size ? size : 1)) return memory;
  throw std::bad_alloc();
}
[[gnu::noinline]] void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  ++allocations;
  return std::malloc(size ? size : 1);
}
[[gnu::noinline]] void* operator new(std::size_t size, std::align_val_t alignment) {
  ++allocations;
  const auto a = static_cast<std::size_t>(alignment);
  if (void* memory = std::aligned_alloc(a, (size + a - 1) / a * a)) return memory;
  throw std::bad_alloc();
}
[[gnu::noinline]] void operator delete(void* memory) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::align_val_t) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::size_t, std::align_val_t) noexcept {
  std::free(memory);
}

namespace acus::haptics {
namespace {

TEST(RecorderAllocation, is_seen_by_this_program) {
  const long before = allocations;
  std::vector<double> some(1000);
  EXPECT_EQ(allocations, before + 1);
  EXPECT_EQ(some[7], 0.0);
}

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
