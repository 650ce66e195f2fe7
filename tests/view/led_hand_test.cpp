#include "acus/view/led_hand.h"

#include <gtest/gtest.h>

namespace acus::view {
namespace {

constexpr double step = 1e-3;  // s

Scene scene() {
  Scene s;
  s.needle.length = 0.2;
  s.needle.radius = 0.3e-3;
  s.hand.speed = 0.01;
  return s;
}

double after(LedHand& hand, int steps) {
  for (int i = 0; i < steps; ++i) hand.advance(step);
  return hand.travel();
}

TEST(LedHand, rests_where_the_scenes_hand_begins) {
  LedHand hand(scene());
  EXPECT_EQ(after(hand, 100), 0.0);
  Scene early = scene();
  early.hand.kind = HandKind::path;
  early.hand.path = {{0.0, -5e-3}, {1.0, 0.0}};
  LedHand waiting(early);
  EXPECT_EQ(after(waiting, 100), -5e-3);
}

TEST(LedHand, glides_to_where_it_is_pushed_at_five_times_the_scenes_speed_and_stops_there) {
  LedHand hand(scene());
  hand.push(0.02);
  EXPECT_NEAR(after(hand, 100), 5.0 * 0.01 * 0.1, 1e-12);
  EXPECT_NEAR(after(hand, 299), 0.01995, 1e-12);
  EXPECT_NEAR(after(hand, 1), 0.02, 1e-12);
  EXPECT_NEAR(after(hand, 100), 0.02, 1e-12);
  hand.push(0.01);
  EXPECT_NEAR(after(hand, 100), 0.015, 1e-12);
}

TEST(LedHand, goes_on_steadily_until_it_is_held_or_pushed) {
  LedHand hand(scene());
  hand.steady(0.03);
  EXPECT_NEAR(after(hand, 1000), 0.03, 1e-12);
  hand.steady(-0.01);
  EXPECT_NEAR(after(hand, 1000), 0.02, 1e-12);
  hand.steady(0.0);
  EXPECT_NEAR(after(hand, 1000), 0.02, 1e-12);
  hand.steady(0.03);
  hand.push(0.0);
  EXPECT_NEAR(after(hand, 400), 0.0, 1e-12);
}

// Ten radii of the needle stay outside, as in every scene; and it can be pulled out by its length.
TEST(LedHand, stays_within_the_needles_length) {
  LedHand hand(scene());
  hand.steady(1.0);
  EXPECT_EQ(after(hand, 1000), 0.2 - 10.0 * 0.3e-3);
  hand.steady(-1.0);
  EXPECT_EQ(after(hand, 1000), -0.2);
  hand.push(10.0);
  EXPECT_EQ(after(hand, 20000), 0.2 - 10.0 * 0.3e-3);
}

}  // namespace
}  // namespace acus::view
