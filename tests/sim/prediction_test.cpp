#include "acus/sim/prediction.h"

#include <gtest/gtest.h>

namespace acus {
namespace {

Scene table_one(double length, needle::Support support = needle::Support::clamped_pinned) {
  Scene scene;
  scene.needle.length = length;
  scene.needle.support = support;
  scene.hand.travel = 0.6 * length;
  return scene;
}

// Fig. 7(a) at a rupture force of 1 N, worked out with clamped-pinned ends: 1.142 / 0.642 / 0.285 N.
TEST(Prediction, needles_of_figure_7a_fall_into_their_zones) {
  const Prediction shorter = predict(table_one(0.150)), middle = predict(table_one(0.200)),
                   longer = predict(table_one(0.300));
  EXPECT_NEAR(shorter.critical_load, 1.142, 1e-3);
  EXPECT_NEAR(middle.critical_load, 0.642, 1e-3);
  EXPECT_NEAR(longer.critical_load, 0.285, 1e-3);
  EXPECT_EQ(shorter.outcome, Outcome::straight_puncture);
  EXPECT_EQ(middle.outcome, Outcome::never_punctured);
  EXPECT_EQ(longer.outcome, Outcome::never_punctured);
}

TEST(Prediction, person_pushes_no_harder_than_the_limit) {
  Scene scene = table_one(0.150);
  scene.hand.kind = HandKind::person;
  EXPECT_EQ(predict(scene).outcome, Outcome::straight_puncture);
  scene.hand.force_limit = 0.9;  // N; the tissue gives way at 1 N
  EXPECT_EQ(predict(scene).outcome, Outcome::never_punctured);
  EXPECT_EQ(predict(scene).highest_load, 0.9);
}

// The elastica's top: 1.14 times the critical load at 46 % end shortening.
TEST(Prediction, clamped_pinned_needle_never_pushes_more_than_1_14_times_its_critical_load) {
  const Prediction p = predict(table_one(0.200));
  EXPECT_NEAR(p.highest_load / p.critical_load, 1.14, 0.005);
}

TEST(Prediction, between_the_critical_load_and_its_top_the_needle_buckles_and_then_punctures) {
  Scene scene = table_one(0.200);
  scene.contact.rupture_force = 0.70;
  EXPECT_EQ(predict(scene).outcome, Outcome::buckled_then_punctured);
  scene.contact.rupture_force = 0.60;
  EXPECT_EQ(predict(scene).outcome, Outcome::straight_puncture);
  scene.contact.rupture_force = 0.75;
  EXPECT_EQ(predict(scene).outcome, Outcome::never_punctured);
}

// 1 N sinks a disc of 5 mm radius by 3.33 mm on a half-space of 25 kPa.
TEST(Prediction, hands_that_do_not_go_far_enough_never_puncture) {
  Scene scene = table_one(0.150);
  scene.contact.contact_radius = 5e-3;
  scene.hand.travel = 2e-3;
  EXPECT_EQ(predict(scene).outcome, Outcome::never_punctured);
  EXPECT_NEAR(predict(scene).highest_load, 2.0 / 3.327, 0.01);
  scene.hand.travel = 5e-3;
  EXPECT_EQ(predict(scene).outcome, Outcome::straight_puncture);
  scene.hand.kind = HandKind::path;
  scene.hand.path = {{0.0, -10e-3}, {1.0, -1e-3}};
  EXPECT_EQ(predict(scene).outcome, Outcome::never_punctured);
  EXPECT_EQ(predict(scene).highest_load, 0.0);
}

// Free lengths at which a needle of 0.3 mm radius buckles at 1.0 N, solved from Euler's formula by hand.
TEST(Prediction, longest_straight_needle_is_eulers) {
  using needle::Support;
  EXPECT_NEAR(predict(table_one(0.2, Support::pinned_pinned)).longest_straight, 0.1121, 1e-4);
  EXPECT_NEAR(predict(table_one(0.2, Support::clamped_pinned)).longest_straight, 0.1603, 1e-4);
  EXPECT_NEAR(predict(table_one(0.2, Support::clamped_clamped)).longest_straight, 0.2241, 1e-4);
}

// 1 N over a disc of 5 mm radius on 25 kPa: the centre sinks 2 (1 - nu^2) p a / E, the mean is 8 / (3 pi) of
// it.
TEST(Prediction, half_space_sinks_as_in_the_textbook) {
  const TissueScene tissue;
  const double pressure = 1.0 / (3.14159265358979 * 5e-3 * 5e-3);
  const double centre = 2.0 * (1.0 - 0.48 * 0.48) * pressure * 5e-3 / 25e3;
  EXPECT_NEAR(half_space_sink(1.0, tissue, 5e-3), centre * 8.0 / (3.0 * 3.14159265358979), 1e-9);
}

TEST(Prediction, a_fixed_stop_is_never_punctured) {
  Scene scene = table_one(0.1);
  scene.tissue.rigid = true;
  EXPECT_EQ(predict(scene).outcome, Outcome::never_punctured);
}

}  // namespace
}  // namespace acus
