// A pace may be late, for any machine may be slow, but it is never early.
#include "acus/haptics/pace.h"

#include <gtest/gtest.h>

namespace acus::haptics {
namespace {

TEST(Pace, is_never_ahead_of_its_schedule) {
  constexpr double period = 2e-3;
  const double begun = monotonic_time();
  Pace pace(period);
  double due = 0.0;  // s since the beginning
  for (int tick = 0; tick < 50; ++tick) {
    due += static_cast<double>(1 + pace.wait()) * period;
    ASSERT_GE(monotonic_time() - begun, due - 1e-9) << "at tick " << tick;
  }
}

TEST(Pace, leaves_out_missed_ticks_instead_of_a_burst) {
  constexpr double period = 1e-3;
  Pace pace(period);
  for (const double begun = monotonic_time(); monotonic_time() - begun < 20.5 * period;) {
  }
  EXPECT_GE(pace.wait(), 20);
  const double caught_up = monotonic_time();
  for (int tick = 0; tick < 10; ++tick) pace.wait();
  EXPECT_GE(monotonic_time() - caught_up, 9.0 * period);
}

}  // namespace
}  // namespace acus::haptics
