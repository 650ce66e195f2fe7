// What the hand can do against buckling: hold the needle further down, guide it.
#include <numbers>

#include "acus/sim/prediction.h"
#include "insertion.h"

using namespace acus;
using namespace acus::physics;
using needle::Support;

namespace {

class Grip : public testing::TestWithParam<NeedleModel> {};
INSTANTIATE_TEST_SUITE_P(Of, Grip, testing::Values(NeedleModel::column, NeedleModel::rod));

TEST_P(Grip, before_the_hub_makes_the_needle_that_much_shorter) {
  Scene scene = table_one(0.2, 12e-3, 20e-3, 600);
  scene.needle_model = GetParam();
  scene.hand.grip = 50e-3;
  scene.run.solver_tolerance = 1e-8;
  Scene shorter = scene;
  shorter.hand.grip = 0.0;
  shorter.needle.length = 0.15;
  shorter.needle.imperfection *= 0.75;
  const Insertion held = insert(scene), other = insert(shorter);
  ASSERT_EQ(held.frames.size(), other.frames.size());
  for (std::size_t i = 0; i < held.frames.size(); ++i)
    ASSERT_NEAR(held.frames[i].hand_force, other.frames[i].hand_force, 1e-6);
  EXPECT_NEAR(held.frames.front().critical_load, 1.142, 1e-3);
}

TEST_P(Grip, leaves_what_is_behind_it_in_line) {
  Scene scene = table_one(0.2, 12e-3, 20e-3, 600);
  scene.needle_model = GetParam();
  scene.hand.grip = 50e-3;
  auto simulation = Simulation::build(scene);
  ASSERT_TRUE(simulation);
  for (int i = 0; i < 100; ++i) simulation->step(1e-4 * i);
  const std::vector<Vec3> line = simulation->needle_line(81);
  double length = 0.0;
  for (std::size_t i = 1; i < line.size(); ++i) length += (line[i] - line[i - 1]).norm();
  EXPECT_NEAR(length, 0.2, 1e-3);
  EXPECT_NEAR((line[20] - simulation->hub().position).norm(), 0.0, 1e-12);
  EXPECT_NEAR((line[0] - line[20]).norm(), 50e-3, 1e-12);
}

// The bare rod against a rigid stop.
Scene guided(Support support, double gap, double length) {
  Scene scene;
  scene.tissue.rigid = true;
  scene.needle.support = support;
  scene.needle.imperfection = 0.02e-3;
  scene.guide.gap = gap;
  scene.guide.length = length;
  scene.hand.speed = 0.5e-3;
  scene.hand.travel = 0.5e-3;
  return scene;
}

// What it carries once it has buckled.
double load_of(const Scene& scene) { return insert(scene).frames.back().hand_force; }

// Within a stiff sleeve the needle stays straight, so that what is outside buckles as a column clamped there:
// 4 pi^2 EI / l^2 between two clamps, 2.04575 pi^2 EI / l^2 between a clamp and the stop's pin. The rod bends
// at its nodes, so that it knows where the sleeve ends to an edge of 1 / 60 of its length.
TEST(Guide, clamps_the_spans_outside_of_it) {
  const auto load = [](double factor, double span) {
    return factor * pinned_pinned_load * std::pow(0.2 / span, 2);
  };
  const auto expect = [&](const Scene& scene, double factor, double span) {
    const double carried = load_of(scene);
    EXPECT_LT(carried, 1.005 * load(factor, span)) << span;
    EXPECT_GT(carried, load(factor, span + 0.2 / 60.0)) << span;
    EXPECT_NEAR(insert(scene).frames.front().critical_load, load(factor, span), 1e-4 * load(factor, span));
  };
  expect(guided(Support::clamped_pinned, 0.0, 80e-3), 4.0, 0.12);
  expect(guided(Support::clamped_pinned, 100e-3, 100e-3), 2.04575, 0.1);
  expect(guided(Support::pinned_pinned, 0.0, 60e-3), 2.04575, 0.14);
}

// A column that is pinned at its ends and held at its middle by a spring of at least 16 pi^2 EI / l^3 buckles
// in two half waves, at four times the load (Timoshenko and Gere, Theory of Elastic Stability, 2.6). Two
// fingers do: they hold, and do not clamp. A little off the middle, so that something tells it which way.
TEST(Guide, of_two_fingers_at_the_middle_makes_it_four_times_as_strong) {
  Scene scene = guided(Support::pinned_pinned, 97.5e-3, 1e-3);
  scene.guide.stiffness = 1e6;
  EXPECT_NEAR(load_of(scene), 4.0 * pinned_pinned_load, 0.005 * 4.0 * pinned_pinned_load);
  scene.guide.length = 0.0;
  EXPECT_NEAR(load_of(scene), pinned_pinned_load, 0.005 * pinned_pinned_load);
}

// In the air, to and fro: all that the hand feels is the guide's friction, 10 N/m on 50 mm, against it; and
// nothing once the needle has left the guide.
TEST(Guide, rubs_along_the_needle_that_is_in_it) {
  Scene scene = table_one(0.2, 1e-3, 20e-3, 600);
  scene.guide = {.length = 50e-3, .gap = 20e-3, .friction = 10.0};
  scene.hand.kind = HandKind::path;
  scene.hand.path = {{0.0, -10e-3}, {0.4, -2e-3}, {0.5, -2e-3}, {2.5, -90e-3}, {2.6, -90e-3}};
  const Insertion run = insert(scene);
  const auto at = [&](double time) {
    return run.frames[static_cast<std::size_t>(std::lround(time * 1e3)) - 1];
  };
  EXPECT_NEAR(at(0.38).hand_force, 0.5, 5e-3);
  EXPECT_NEAR(at(0.7).hand_force, -0.5, 5e-3);
  EXPECT_NEAR(at(1.6).hand_force, -10.0 * 20e-3, 0.02);  // 50 mm back: 20 of the guide are still around it
  EXPECT_NEAR(at(2.6).hand_force, 0.0, 1e-4);
  for (std::size_t i = 1; i < run.frames.size(); ++i)
    ASSERT_GE(run.frames[i].ledger.work_friction, run.frames[i - 1].ledger.work_friction - 1e-15);
}

// A hand that comes down to the guide pushes it together, and a needle that would buckle without it goes in.
TEST(Guide, lets_the_hand_pass) {
  Scene scene = table_one(0.12, 90e-3, 100e-3, 600);
  scene.contact.rupture_force = 2.0;
  scene.contact.friction = 10.0;
  EXPECT_TRUE(insert(scene).first(EventKind::buckling));
  scene.guide = {.length = 60e-3, .friction = 5.0};
  const Insertion run = insert(scene);
  EXPECT_NEAR(run.frames.back().hand_travel, 90e-3, 1e-6);
  EXPECT_FALSE(run.first(EventKind::buckling));
  for (const Frame& f : run.frames) ASSERT_GE(f.ledger.work_numerical, -1e-4 * f.ledger.work_hand) << f.time;
}

// Caught from aside, a needle is held where it was caught and led to the middle as it slides, by no more than
// what it takes to bend it. Springs that threw it there at once would give it joules.
TEST(Guide, takes_a_needle_as_it_finds_it) {
  Scene scene = table_one(0.15, 1e-3, 20e-3, 600);
  scene.guide = {.length = 50e-3, .gap = 20e-3};
  auto simulation = Simulation::build(scene);
  ASSERT_TRUE(simulation);
  needle::Pose hub = simulation->hub();
  const Vec3 aside = hub.director, along = hub.tangent;
  const auto lead = [&](const Vec3& by, int steps) {
    for (int i = 0; i < steps; ++i) {
      hub.position += by / steps;
      ASSERT_EQ(simulation->step(hub).health, Health::good);
      ASSERT_GT(simulation->frame().ledger.work_numerical, -1e-3);
    }
  };
  lead(-0.1 * along, 500);  // out of the guide, aside, and down again
  lead(5e-3 * aside, 100);
  lead(0.08 * along, 500);
  EXPECT_LT(simulation->frame().hub_force.norm(), 0.5);
}

// What `acus check` advises against buckling does help, and a tenth less does not: 200 mm against 1 N. (A bow
// has inertia: pushed at 10 mm/s a span carries up to a tenth more than its critical load before it gives
// way.)
TEST(Remedy, of_a_grip_or_a_sleeve_keeps_the_needle_straight) {
  Scene scene = table_one(0.2, 25e-3, 10e-3, 1000);
  const Prediction p = predict(scene);
  ASSERT_EQ(p.outcome, Outcome::never_punctured);
  const auto goes_in_straight = [](const Scene& s) {
    const Insertion run = insert(s, [](const Frame& f) { return f.inserted_length > 0.0; });
    return run.first(EventKind::puncture) && !run.first(EventKind::buckling);
  };
  for (const double more : {2e-3, -15e-3}) {
    Scene held = scene;
    held.hand.grip = 0.2 - p.longest_straight + more;
    EXPECT_EQ(goes_in_straight(held), more > 0.0) << more;
    Scene thin = scene;  // so that the sleeve has to do more than to stand there
    thin.needle.radius = 0.25e-3;
    const double span = predict(thin).longest_in_sleeve;
    ASSERT_LT(span, 0.2);
    thin.guide.length = 0.2 - span + more;
    EXPECT_EQ(goes_in_straight(thin), more > 0.0) << more;
  }
}

TEST(HubWrench, is_told_with_the_parts_of_the_force_along_the_needle) {
  const Insertion run = insert(table_one(0.15, 40e-3, 50e-3, 600));
  const Frame& f = run.frames.back();
  ASSERT_GT(f.inserted_length, 20e-3);
  EXPECT_NEAR(f.hub_force.z(), -f.hand_force, 1e-9);  // the needle goes down
  // 40 N/m on what is inside, but for the last to go in, which is still to slip (40 N/m over the stiffness of
  // the tissue beside the shaft, 2 pi G: 0.75 mm, and more where the mesh is coarse).
  EXPECT_LE(f.shaft_force, 40.0 * f.inserted_length);
  EXPECT_GE(f.shaft_force, 40.0 * (f.inserted_length - 1.5e-3));
  EXPECT_NEAR(f.tip_force + f.shaft_force, f.hand_force, 0.02 * f.hand_force);
}

}  // namespace
