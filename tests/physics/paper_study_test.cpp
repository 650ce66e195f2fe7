// The paper's Fig. 6 and 7: the four stages, and reaction force against insertion for lengths and radii.
#include "insertion.h"

using namespace acus;
using namespace acus::physics;
using needle::Support;

namespace {

// studies/fig6.toml's clamped-pinned run.
Scene fig6(int tetrahedra) {
  Scene scene = column_in_table_one(0.2, 58e-3, 20e-3, tetrahedra);
  scene.tissue.element = Element::linear;
  scene.contact.rupture_force = 0.66;
  scene.contact.fracture_toughness = 76.0;
  scene.contact.friction = 20.0;
  return scene;
}

// studies/fig6.toml's clamped-pinned run on a coarser mesh: the figure's four pictures in their order. The
// second buckling comes where Euler's load of the free part that is left is met; friction reaches it at 153
// mm, 1.10 N.
TEST(Fig6, goes_through_contact_buckling_puncture_and_second_buckling) {
  const Scene scene = fig6(3000);
  const Insertion run = insert(scene);
  const EventKind order[] = {EventKind::contact, EventKind::buckling, EventKind::puncture,
                             EventKind::straightening, EventKind::second_buckling};
  double before = -1.0;
  for (EventKind kind : order) {
    const auto event = run.first(kind);
    ASSERT_TRUE(event) << static_cast<int>(kind);
    EXPECT_GE(event->time, before);
    before = event->time;
  }
  const Event second = *run.first(EventKind::second_buckling);
  EXPECT_NEAR(second.free_length, 0.153, 2e-3);
  EXPECT_NEAR(second.hand_force, euler_load(scene, second.free_length), 0.01 * second.hand_force);
  EXPECT_NEAR(second.hand_force, 1.10, 0.02);
}

// What the solver leaves by default, and what floats do, moves the felt force by less than 0.5 % at every
// step.
TEST(Fig6, feels_as_if_it_were_solved_exactly) {
  Scene scene = fig6(1000);
  const Insertion usual = insert(scene);
  scene.run.solver_tolerance = 1e-9;
  scene.run.solver_precision = Precision::double_;
  const Insertion exact = insert(scene);
  ASSERT_EQ(usual.frames.size(), exact.frames.size());
  double worst = 0.0;
  for (std::size_t i = 0; i < usual.frames.size(); ++i) {
    const double force = exact.frames[i].hand_force, off = std::abs(usual.frames[i].hand_force - force);
    if (std::abs(force) > 0.02) worst = std::max(worst, off / std::abs(force));
  }
  EXPECT_LT(worst, 5e-3);
  EXPECT_GT(worst, 0.0);
}

// Load where the distance of the needle's ends has shortened by 1 %: the exact elastica has 1.0038 times the
// critical load there when clamped and pinned (shooting), however much the tissue has given way by then.
double load_at_one_percent(const Insertion& run) {
  for (const Frame& f : run.frames)
    if (f.hand_travel - f.tip_depth >= 0.01 * run.scene.needle.length) return f.hand_force;
  ADD_FAILURE() << "never shortened by 1 %";
  return 0.0;
}

Scene fig7(double length, double radius, Support support, double travel, int tetrahedra = 3000) {
  Scene scene = column_in_table_one(length, travel, 40e-3, tetrahedra);
  scene.needle.radius = radius;
  scene.needle.support = support;
  scene.tissue.element = Element::linear;
  return scene;
}

TEST(Fig7a, clamped_pinned_150_mm_punctures_straight_at_the_rupture_force) {
  const Insertion run = insert(fig7(0.15, 0.3e-3, Support::clamped_pinned, 20e-3));
  EXPECT_FALSE(run.first(EventKind::buckling));
  const auto puncture = run.first(EventKind::puncture);
  ASSERT_TRUE(puncture);
  EXPECT_NEAR(puncture->hand_force, 1.0, 0.01);
}

// 10 k tetrahedra; 0.642 N = 2.04575 pi^2 EI / L^2. The tissue gives way under the tip by millimetres before
// that, which shifts the travel at buckling, not the load.
TEST(Fig7a, clamped_pinned_200_mm_buckles_and_never_punctures_however_far_it_is_pushed) {
  Scene scene = fig7(0.2, 0.3e-3, Support::clamped_pinned, 120e-3, 10000);
  scene.hand.kind =
      HandKind::path;  // slowly to the buckling load, then far beyond the elastica's greatest load
  scene.hand.path = {{0.0, 0.0}, {0.3, 12e-3}, {1.0, 125e-3}};
  const Insertion run = insert(scene);
  const auto buckling = run.first(EventKind::buckling);
  ASSERT_TRUE(buckling);
  EXPECT_NEAR(buckling->hand_force, 0.642, 0.05 * 0.642);
  EXPECT_NEAR(load_at_one_percent(run), 1.0038 * 0.642, 0.01 * 0.642);
  EXPECT_GT(buckling->hand_travel, 2e-3);
  EXPECT_FALSE(run.first(EventKind::puncture));
  double greatest = 0.0;
  for (const Frame& f : run.frames) greatest = std::max(greatest, f.hand_force);
  EXPECT_NEAR(greatest, 1.14 * 0.642, 0.01 * 0.732);  // the clamped-pinned elastica's greatest load
  EXPECT_LT(run.frames.back().hand_force, greatest);  // and it has been passed
}

TEST(Fig7a, clamped_pinned_300_mm_buckles_at_the_smaller_load) {
  const Insertion run = insert(fig7(0.3, 0.3e-3, Support::clamped_pinned, 40e-3));
  const auto buckling = run.first(EventKind::buckling);
  ASSERT_TRUE(buckling);
  EXPECT_NEAR(buckling->hand_force, 0.285, 0.05 * 0.285);
  EXPECT_NEAR(load_at_one_percent(run), 1.0038 * 0.285, 0.01 * 0.285);
  EXPECT_FALSE(run.first(EventKind::puncture));
}

TEST(Fig7a, pinned_pinned_all_three_lengths_buckle_below_the_rupture_force) {
  const std::pair<double, double> cases[] = {{0.15, 0.558}, {0.2, 0.314}, {0.3, 0.140}};  // Eq. 10 on Table I
  for (auto [length, load] : cases) {
    const Insertion run = insert(fig7(length, 0.3e-3, Support::pinned_pinned, 25e-3));
    const auto buckling = run.first(EventKind::buckling);
    ASSERT_TRUE(buckling) << length;
    EXPECT_NEAR(buckling->hand_force, load, 0.01 * load) << length;
    EXPECT_NEAR(load_at_one_percent(run), 1.0050 * load, 0.01 * load) << length;  // that elastica by shooting
    EXPECT_FALSE(run.first(EventKind::puncture)) << length;
  }
}

TEST(Fig7b, buckling_loads_rank_as_the_fourth_power_of_the_radius) {
  double reference = 0.0;
  for (double radius : {0.2e-3, 0.25e-3, 0.3e-3}) {
    const Insertion run = insert(fig7(0.2, radius, Support::clamped_pinned, 14e-3));
    const auto buckling = run.first(EventKind::buckling);
    ASSERT_TRUE(buckling) << radius;
    if (reference == 0.0) reference = buckling->hand_force / std::pow(radius, 4);
    EXPECT_NEAR(buckling->hand_force / std::pow(radius, 4), reference, 0.01 * reference) << radius;
  }
  const Insertion thick = insert(fig7(0.2, 0.4e-3, Support::clamped_pinned, 14e-3));
  EXPECT_FALSE(thick.first(EventKind::buckling));  // 2.03 N before it would
  EXPECT_TRUE(thick.first(EventKind::puncture));
}

}  // namespace
