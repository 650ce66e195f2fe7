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

}  // namespace
}  // namespace acus
