// A spring whose force stands still between rare words, and the damper that makes up for it.
#include "acus/haptics/hold_damper.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "acus/haptics/handle.h"
#include "acus/haptics/virtual_coupling.h"

namespace acus::haptics {
namespace {

constexpr double tick = 1e-3;  // s

// Over one word the hold gives a hand of constant speed K (v h)^2 / 2 at most; the damper takes twice that.
TEST(HoldDamper, takes_twice_what_the_hold_gives) {
  for (double interval : {25e-3, 33e-3, 40e-3})
    for (double stiffness : {100.0, 350.0}) {
      HoldDamper damper(tick);
      damper.word(interval);
      const double held = interval - followed_age, speed = 1e-3;
      double taken = 0.0;
      for (int word = 0; word < 20; ++word)  // the first ones fill its memory of a few milliseconds
        for (int i = 0; i < std::lround(interval / tick); ++i) {
          const double force = damper.force(speed * tick, stiffness, i >= 20);
          if (word >= 10) taken += 0.1 * force * speed * tick;
        }
      const double given = 0.5 * stiffness * std::pow(speed * held, 2);
      // It answers in the followed time for the way of the whole word.
      EXPECT_NEAR(taken, 2.0 * given * interval / followed_age, 0.02 * given) << interval << " " << stiffness;
    }
}

TEST(HoldDamper, is_nothing_where_no_force_is_held) {
  HoldDamper damper(tick);
  EXPECT_EQ(damper.force(1e-4, 300.0, false), 0.0);  // no word yet
  for (double interval : {1e-3, 10e-3, 20e-3}) {
    damper.word(interval);
    EXPECT_EQ(damper.force(1e-4, 300.0, false), 0.0);
  }
  damper.word(33e-3);
  EXPECT_EQ(damper.force(1e-4, 300.0, true), 0.0);
  EXPECT_GT(damper.force(0.0, 300.0, false), 0.0);  // it comes later
}

TEST(HoldDamper, is_no_stronger_for_a_hand_that_goes_far) {
  HoldDamper damper(tick);
  damper.word(33e-3);
  const double force = damper.force(0.2e-3, 300.0, false);
  for (int i = 0; i < 100; ++i) EXPECT_LE(damper.force(5e-3, 300.0, false), force + 1e-12);
}

TEST(HoldDamper, is_not_spoilt_by_numbers_that_are_none) {
  for (double bad : {std::nan(""), std::numeric_limits<double>::infinity(), 1e300, -1e300}) {
    HoldDamper damper(tick);
    damper.word(bad);
    damper.force(bad, 300.0, false);
    damper.force(1e-4, bad, false);
    damper.word(33e-3);
    EXPECT_TRUE(std::isfinite(damper.force(1e-4, 300.0, false))) << bad;
  }
}

// A handle without dry friction in the coupling, followed for 20 ms and held for 13, as the gate does: how a
// swing of a tenth of a millimetre changes in two seconds, with the damper and without.
double swing_left(bool damped) {
  const DeviceLimits limits = *find_device_limits("ice");
  const VirtualCoupling coupling = coupling_for(limits, tick);
  constexpr double start = 0.1e-3;  // m
  DeviceLimits exact = limits;
  exact.quantum = 0.0;
  Handle handle(exact, no_hand, {start, 0.0, 0.0});
  HoldDamper damper(tick);
  damper.word(33e-3);
  double before = start, held = 0.0, largest = 0.0;
  for (int i = 0; i < 2000; ++i) {
    const double x = handle.position().x(), speed = (x - before) / tick;
    before = x;
    const bool followed = i % 33 < 20, may_be_held = i % 33 >= 18;
    const double answer = damper.force(speed * tick, coupling.stiffness, may_be_held);
    if (followed) held = coupling.stiffness * x + (may_be_held ? 0.0 : coupling.damping * speed);
    if (followed && damped) held += answer;
    // While it holds, the gate damps by 1 N s/m.
    handle.command({-held - (followed ? 0.0 : speed), 0.0, 0.0});
    handle.advance_to((i + 1) * tick, {});
    if (i >= 1900) largest = std::max(largest, std::abs(x));
  }
  return largest / start;
}

TEST(HoldDamper, keeps_a_held_spring_from_swinging) {
  EXPECT_GT(swing_left(false), 1.0);
  EXPECT_LT(swing_left(true), 1e-3);
}

}  // namespace
}  // namespace acus::haptics
