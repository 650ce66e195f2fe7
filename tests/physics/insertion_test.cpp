// What one insertion of the paper's needle must show, on a small mesh.
#include "insertion.h"

#include <numbers>

using namespace acus;
using namespace acus::physics;

namespace {

// Ring crack: J_c 2 pi r = 164 * 2 pi * 0.3e-3 N.
constexpr double cutting_force = 164.0 * 2.0 * std::numbers::pi * 0.3e-3;

const Insertion& short_needle() {  // punctures without buckling, goes 40 mm deep
  static const Insertion run = insert(column_in_table_one(0.15, 40e-3));
  return run;
}

TEST(Insertion, tissue_ruptures_exactly_at_the_rupture_force) {
  const auto puncture = short_needle().first(EventKind::puncture);
  ASSERT_TRUE(puncture);
  EXPECT_NEAR(puncture->hand_force, 1.0, 1e-6);
  double tip = 0.0;
  for (const Frame& f : short_needle().frames) tip = std::max(tip, f.tip_force);
  EXPECT_DOUBLE_EQ(tip, 1.0);
}

TEST(Insertion, force_falls_to_cutting_plus_friction_after_the_puncture) {
  const auto puncture = short_needle().first(EventKind::puncture);
  ASSERT_TRUE(puncture);
  // 0.2 s later the tissue has come to rest on the shaft and the needle cuts again.
  for (const Frame& f : short_needle().frames) {
    if (f.time < puncture->time + 0.2) continue;
    EXPECT_NEAR(f.tip_force, cutting_force, 1e-9);
    // The last millimetre of pre-sliding is not yet fully loaded: at most friction times 1 mm is missing.
    EXPECT_NEAR(f.hand_force, cutting_force + 40.0 * f.inserted_length, 0.04 + 0.01 * f.hand_force) << f.time;
    EXPECT_LT(f.deflection, 1e-3);
  }
}

TEST(Insertion, force_grows_linearly_with_depth_at_the_friction_per_length) {
  const Frame& a = short_needle().at_travel(20e-3);
  const Frame& b = short_needle().at_travel(39e-3);
  const double slope = (b.hand_force - a.hand_force) / (b.inserted_length - a.inserted_length);
  EXPECT_NEAR(slope, 40.0, 0.02 * 40.0);
}

TEST(Insertion, tissue_slides_back_up_the_shaft_after_the_puncture) {
  const auto puncture = short_needle().first(EventKind::puncture);
  ASSERT_TRUE(puncture);
  for (const Frame& f : short_needle().frames)
    if (f.time > puncture->time + 0.1) {
      // The hub has hardly moved, yet needle is inside: the surface has come up.
      const double hub_since = f.hand_travel - puncture->hand_travel;
      EXPECT_GT(f.inserted_length, hub_since + 2e-3);
      break;
    }
}

TEST(Insertion, buckled_needle_springs_straight_and_buckles_again_deeper_in) {
  Scene scene = column_in_table_one(0.2, 60e-3);
  scene.contact.rupture_force = 0.66;  // between the critical load 0.642 N and 1.14 times it
  scene.contact.friction = 20.0;  // low enough that the released bow drives the tip in until it is straight
  const Insertion run = insert(scene);
  const auto buckling = run.first(EventKind::buckling);
  const auto puncture = run.first(EventKind::puncture);
  const auto straight = run.first(EventKind::straightening);
  const auto second = run.first(EventKind::second_buckling);
  ASSERT_TRUE(buckling && puncture && straight && second);
  EXPECT_LT(buckling->time, puncture->time);
  EXPECT_LT(puncture->time, straight->time);
  EXPECT_LT(straight->time, second->time);
  EXPECT_NEAR(buckling->hand_force, euler_load(scene, 0.2), 0.01 * buckling->hand_force);
  EXPECT_NEAR(second->hand_force, euler_load(scene, second->free_length), 0.01 * second->hand_force);
  double bow_at_puncture = 0.0, least_after = 1.0;
  for (const Frame& f : run.frames) {
    if (f.time <= puncture->time) bow_at_puncture = f.deflection;
    if (f.time > straight->time && f.time < second->time) least_after = std::min(least_after, f.deflection);
  }
  EXPECT_GT(bow_at_puncture, 20e-3);
  EXPECT_LT(least_after, 0.5e-3);
}

TEST(Insertion, hub_travel_is_sink_of_the_tissue_plus_end_shortening_of_the_elastica) {
  const Insertion run = insert(column_in_table_one(0.2, 30e-3));
  const Frame& f = run.frames.back();
  ASSERT_EQ(f.stage, Stage::buckled);
  const double d = (f.hand_travel - f.tip_depth) / 0.2;
  EXPECT_GT(d, 0.1);
  // Clamped-pinned elastica between the tabulated 10 % and 20 %: P / P_cr = 1.0380 + 0.378 (d - 0.1), to
  // 1e-3.
  EXPECT_NEAR(f.hand_force / euler_load(run.scene, 0.2), 1.0380 + (1.0758 - 1.0380) / 0.1 * (d - 0.1), 2e-3);
  EXPECT_NEAR(f.tip_force, f.hand_force, 1e-4);
}

TEST(Insertion, nothing_chatters_at_the_buckling_load) {
  for (double step : {0.25e-3, 1e-3, 2e-3}) {
    Scene scene = column_in_table_one(0.2, 12e-3);
    scene.run.time_step = step;
    const Insertion run = insert(scene);
    const auto buckling = run.first(EventKind::buckling);
    ASSERT_TRUE(buckling);
    EXPECT_NEAR(buckling->hand_force, euler_load(scene, 0.2), 0.005 * buckling->hand_force) << step;
    // From a tenth of the load on the force never falls again: a steadily pushed column only gains load.
    double before = 0.0;
    for (const Frame& f : run.frames) {
      if (f.hand_force > 0.06) {
        EXPECT_GE(f.hand_force, before - 1e-6) << "at " << f.time << " s, step " << step;
      }
      before = f.hand_force;
    }
  }
}

TEST(Insertion, a_hand_at_rest_feels_a_steady_force) {
  Scene scene = column_in_table_one(0.2, 15e-3);
  scene.hand.kind = HandKind::path;
  scene.hand.path = {{0.0, 0.0}, {1.0, 15e-3}, {3.0, 15e-3}};
  const Insertion run = insert(scene);
  const Frame& early = run.frames[1500];
  const Frame& late = run.frames.back();
  EXPECT_GT(late.hand_force, 0.6);
  EXPECT_NEAR(late.hand_force, early.hand_force, 1e-4);
  EXPECT_NEAR(late.energy_force, early.energy_force, 1e-9);
  EXPECT_LT(late.ledger.energy_kinetic, 1e-12);
}

TEST(Insertion, needle_that_comes_out_at_the_far_side_feels_friction_alone) {
  Scene scene = column_in_table_one(0.15, 40e-3);
  scene.tissue.size = Vec3(0.06, 0.06, 0.03);
  scene.tissue.tetrahedra = 2000;
  const Insertion run = insert(scene);
  ASSERT_TRUE(run.first(EventKind::exit));
  const Frame& f = run.frames.back();
  EXPECT_EQ(f.tip_force, 0.0);
  EXPECT_LT(f.inserted_length, 30e-3);
  EXPECT_NEAR(f.hand_force, 40.0 * f.inserted_length, 0.02 * f.hand_force);
}

TEST(Insertion, nearest_node_cuts_as_deep_as_the_needle_goes) {
  Scene scene = column_in_table_one(0.15, 40e-3);
  scene.tissue.size = Vec3(0.06, 0.06, 0.03);
  scene.contact.coupling = Coupling::nearest_node;
  const Insertion run = insert(scene);
  const auto exit = run.first(EventKind::exit);
  ASSERT_TRUE(exit);
  EXPECT_LT(exit->hand_travel, 36e-3);  // 30 mm of tissue, and what it gives way at the far side's last cells
  EXPECT_LT(run.frames.back().inserted_length, 34e-3);
}

TEST(Insertion, needle_with_a_large_initial_bow_counts_as_buckled_when_it_is_bent) {
  Scene scene = column_in_table_one(0.2, 25e-3);
  scene.needle.imperfection = 2e-3;
  const Insertion run = insert(scene);
  const auto buckling = run.first(EventKind::buckling);
  ASSERT_TRUE(buckling);
  // P = P_cr (1 - A_0 / A) with A_0 = 2 mm and A = 5 % of 200 mm.
  EXPECT_NEAR(buckling->hand_force, 0.642 * (1.0 - 2.0 / 10.0), 0.02 * 0.642);
}

}  // namespace
