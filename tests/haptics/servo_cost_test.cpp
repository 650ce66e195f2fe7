// What a tick may not do: allocate, take a lock, touch memory that is not there.
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <cmath>

#include "acus/haptics/newest_value.h"
#include "acus/haptics/servo.h"
#include "tests/counted_allocations.h"
#include "tests/counted_locks.h"

namespace acus::haptics {
namespace {

long page_faults() {
  rusage usage{};
  getrusage(RUSAGE_THREAD, &usage);
  return usage.ru_minflt + usage.ru_majflt;
}

TEST(ServoCost, hooks_see_what_they_are_for) {
  const long allocated = allocations, locked = locks, faulted = page_faults();
  std::vector<char> some(64u << 20, 1);
  pthread_mutex_t mutex = PTHREAD_MUTEX_INITIALIZER;
  pthread_mutex_lock(&mutex);
  pthread_mutex_unlock(&mutex);
  EXPECT_GT(allocations, allocated);
  EXPECT_GT(locks, locked);
  EXPECT_GT(page_faults(), faulted);
  EXPECT_EQ(some.back(), 1);
}

TEST(ServoCost, a_million_ticks_allocate_lock_and_fault_nothing) {
  Servo servo({*find_device_limits("touch"), 0.0, -1e-3, 1e-3});
  NewestValue<LocalForce> mailbox;
  NewestValue<double> hand;
  const auto tick = [&](long i) {
    DeviceState state;
    state.time = static_cast<double>(i) * 1e-3;
    state.position =
        Vec3(0.0, 0.0, i < 1000 ? 0.0 : -5e-3 + 5e-3 * std::cos(static_cast<double>(i - 1000) * 1e-3));
    state.ready = true;
    if (i % 5 == 0) {
      LocalForce word{state.time, hand.read(), 100.0 * std::max(hand.read(), 0.0), 100.0, 10e-3, i / 50};
      word.stored = 1.0;
      mailbox.write(word);
    }
    const Wrench wrench = servo.tick(state, mailbox.read());
    hand.write(servo.hand().travel);
    return wrench.force.norm();
  };
  double largest = 0.0;
  constexpr long warm =
      20'000;  // every page of the code has been touched once; mlockall does that for the real loop
  for (long i = 0; i < warm; ++i) tick(i);
  const long allocated = allocations, locked = locks, faulted = page_faults();
  for (long i = warm; i < warm + 1'000'000; ++i) largest = std::max(largest, tick(i));
  EXPECT_EQ(allocations, allocated);
  EXPECT_EQ(locks, locked);
  EXPECT_EQ(page_faults(), faulted);
  EXPECT_GT(largest, 0.3);  // it was felt
}

}  // namespace
}  // namespace acus::haptics
