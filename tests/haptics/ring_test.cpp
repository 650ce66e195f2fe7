#include "acus/haptics/ring.h"

#include <gtest/gtest.h>

#include <thread>

namespace acus::haptics {
namespace {

TEST(Ring, holds_the_next_power_of_two_and_refuses_one_more) {
  Ring<int> ring(5);
  EXPECT_EQ(ring.capacity(), 8U);
  for (int i = 0; i < 8; ++i) EXPECT_TRUE(ring.push(i));
  EXPECT_FALSE(ring.push(8));
  int thing = -1;
  EXPECT_TRUE(ring.pop(thing));
  EXPECT_EQ(thing, 0);
  EXPECT_TRUE(ring.push(8));
  for (int i = 1; i <= 8; ++i) {
    EXPECT_TRUE(ring.pop(thing));
    EXPECT_EQ(thing, i);
  }
  EXPECT_FALSE(ring.pop(thing));
  EXPECT_EQ(ring.size(), 0U);
}

// Wide enough to be torn, were it read while it is written.
struct Wide {
  long number = 0;
  long copies[7] = {};
};

TEST(Ring, between_two_threads_loses_doubles_and_tears_nothing) {
  constexpr long count = 300'000;
  Ring<Wide> ring(64);
  std::thread pushing([&] {
    for (long i = 0; i < count; ++i) {
      Wide wide{i, {i, i, i, i, i, i, i}};
      while (!ring.push(wide)) std::this_thread::yield();
    }
  });
  long wrong = 0;
  for (long i = 0; i < count; ++i) {
    Wide wide;
    while (!ring.pop(wide)) std::this_thread::yield();
    if (wide.number != i) ++wrong;
    for (const long copy : wide.copies)
      if (copy != i) ++wrong;
  }
  pushing.join();
  EXPECT_EQ(wrong, 0);
}

}  // namespace
}  // namespace acus::haptics
