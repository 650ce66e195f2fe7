#include "acus/sim/hand.h"

#include <gtest/gtest.h>

namespace acus {
namespace {

TEST(Hand, steady_hand_goes_at_its_speed_and_then_rests) {
  const HandScene hand{.kind = HandKind::steady, .speed = 0.01, .travel = 0.05, .path = {}};
  EXPECT_DOUBLE_EQ(duration(hand), 5.0);
  EXPECT_DOUBLE_EQ(planned_travel(hand, 0.0), 0.0);
  EXPECT_DOUBLE_EQ(planned_travel(hand, 2.0), 0.02);
  EXPECT_DOUBLE_EQ(planned_travel(hand, 7.0), 0.05);
  EXPECT_DOUBLE_EQ(planned_travel(hand, -1.0), 0.0);
}

TEST(Hand, path_hand_pauses_withdraws_and_meets_every_point) {
  const HandScene hand{.kind = HandKind::path, .path = {{0.0, -0.01}, {2.0, 0.03}, {3.0, 0.03}, {4.0, 0.0}}};
  EXPECT_DOUBLE_EQ(duration(hand), 4.0);
  for (const HandPoint& point : hand.path) EXPECT_DOUBLE_EQ(planned_travel(hand, point.time), point.travel);
  EXPECT_DOUBLE_EQ(planned_travel(hand, 1.0), 0.01);     // half way in
  EXPECT_DOUBLE_EQ(planned_travel(hand, 2.5), 0.03);     // pause
  EXPECT_DOUBLE_EQ(planned_travel(hand, 3.75), 0.0075);  // on the way out
  EXPECT_DOUBLE_EQ(planned_travel(hand, 9.0), 0.0);
}

// One way for every hand: step by step, whatever is felt, the very numbers of the plan.
TEST(Hand, that_was_planned_feels_nothing_and_ends_with_its_plan) {
  const HandScene steady{.kind = HandKind::steady, .speed = 0.03, .travel = 0.0101, .path = {}};
  const HandScene path{.kind = HandKind::path, .path = {{0.0, -0.01}, {0.2, 0.03}, {0.5, 0.0}}};
  for (const HandScene& scene : {steady, path})
    for (double step : {1e-3, 0.7e-3}) {
      Hand hand(scene, step);
      int steps = 0;
      while (const auto travel = hand.next(100.0)) EXPECT_EQ(*travel, planned_travel(scene, ++steps * step));
      EXPECT_EQ(steps, step_count(scene, step));
      EXPECT_GE(steps * step, duration(scene) - 1e-9);
      EXPECT_FALSE(hand.next(0.0));
    }
}

}  // namespace
}  // namespace acus
