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

// The same from the other side: at its longest straight length a needle needs just the radius it has; and the
// radius by hand, (4 F L^2 / (2.04575 pi^3 E))^(1/4) = 0.3351 mm for 200 mm at 1 N.
TEST(Prediction, least_straight_radius_is_eulers) {
  EXPECT_NEAR(predict(table_one(0.2)).least_radius, 0.3351e-3, 1e-7);
  EXPECT_NEAR(predict(table_one(0.1603)).least_radius, 0.3e-3, 1e-7);
}

// A sleeve on the tissue clamps the needle where it begins.
TEST(Prediction, a_sleeve_makes_clamped_of_pinned) {
  using needle::Support;
  EXPECT_NEAR(predict(table_one(0.2, Support::pinned_pinned)).longest_in_sleeve, 0.1603, 1e-4);
  EXPECT_NEAR(predict(table_one(0.2, Support::clamped_pinned)).longest_in_sleeve, 0.2241, 1e-4);
  EXPECT_NEAR(predict(table_one(0.2, Support::clamped_clamped)).longest_in_sleeve, 0.2241, 1e-4);
}

// 1 N sinks a disc of 5 mm radius by 3.327 mm on a half-space of 25 kPa, and 0.642 N by as much less.
TEST(Prediction, buckling_comes_where_the_tissue_has_sunk_under_the_critical_load) {
  Scene scene = table_one(0.200);
  scene.contact.contact_radius = 5e-3;
  const Prediction p = predict(scene);
  ASSERT_TRUE(p.buckling);
  EXPECT_FALSE(p.buckling->inside);
  EXPECT_NEAR(p.buckling->load, 0.642, 1e-3);
  EXPECT_NEAR(p.buckling->hand_travel, 0.642 * 3.327e-3, 1e-5);
  EXPECT_NE(buckling_in_words(scene, p).find("before the puncture, at 0.642 N, about 2.14 mm"),
            std::string::npos)
      << buckling_in_words(scene, p);
}

// 150 mm under friction of 60 N/m and cutting of 2 pi x 0.3 mm x 164 J/m^2 = 0.309 N: by hand, 2.04575 pi^2
// EI = 25.69e-3 N m^2 over (150 - d)^2 meets 0.309 + 60 d at d = 20.5 mm.
TEST(Prediction, a_needle_that_goes_in_straight_buckles_where_friction_has_grown_to_its_load) {
  Scene scene = table_one(0.150);
  scene.contact.friction = 60.0;
  const Prediction p = predict(scene);
  EXPECT_EQ(p.outcome, Outcome::straight_puncture);
  ASSERT_TRUE(p.buckling);
  EXPECT_TRUE(p.buckling->inside);
  const double d = p.buckling->hand_travel;
  EXPECT_NEAR(25.69e-3 / ((0.150 - d) * (0.150 - d)), 0.309 + 60.0 * d, 2e-3);
  EXPECT_NEAR(p.buckling->load, 0.309 + 60.0 * d, 1e-3);
  scene.contact.friction = 20.0;  // the free part shortens faster than the load grows
  EXPECT_FALSE(predict(scene).buckling);
}

TEST(Prediction, a_hand_that_stays_away_or_pushes_too_little_buckles_nothing) {
  Scene scene = table_one(0.200);
  scene.hand.travel = 1e-3;
  EXPECT_FALSE(predict(scene).buckling);
  scene = table_one(0.200);
  scene.hand.kind = HandKind::person;
  scene.hand.force_limit = 0.5;  // N, of 0.642
  EXPECT_FALSE(predict(scene).buckling);
}

TEST(Prediction, what_would_help_is_said_with_its_numbers) {
  const Scene scene = table_one(0.200), good = table_one(0.150);
  const auto help = remedies_in_words(scene, predict(scene)), margin = remedies_in_words(good, predict(good));
  ASSERT_EQ(help.size(), 4u);
  EXPECT_EQ(help[0], "A grip that leaves at most 160.2 mm free keeps it straight up to 1.00 N.");
  EXPECT_EQ(help[1], "So does a radius of at least 0.335 mm at this length.");
  EXPECT_EQ(help[2], "So does a tip sharp enough to go in at less than 0.642 N.");
  EXPECT_EQ(help[3], "So does a sleeve that stands on the tissue and leaves at most 224.1 mm of it free.");
  ASSERT_EQ(margin.size(), 3u);
  EXPECT_NE(margin[2].find("up to 1.14 N"), std::string::npos);
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
