// Pause, withdrawal and re-insertion into the same channel.
#include "insertion.h"

using namespace acus;
using namespace acus::physics;

namespace {

constexpr double deep = 25e-3;  // m

const Insertion& in_and_out_and_in() {
  static const Insertion run = [] {
    Scene scene = table_one(0.15, 20e-3);
    scene.contact.rupture_force = 0.7;
    scene.hand.kind = HandKind::path;
    scene.hand.path = {{0.0, 0.0}, {1.0, deep}, {1.3, deep}, {2.5, -5e-3}, {2.8, -5e-3}, {4.2, 30e-3}};
    return insert(scene);
  }();
  return run;
}
const Frame& at_time(double time) {
  return in_and_out_and_in().frames[static_cast<std::size_t>(time * 1000.0) - 1];
}

TEST(Withdrawal, friction_turns_round_and_pulls_the_hand) {
  const Frame& f = at_time(1.8);
  EXPECT_EQ(f.tip_force, 0.0);
  EXPECT_NEAR(f.hand_force, -40.0 * f.inserted_length, 0.05 * 40.0 * f.inserted_length);
}

TEST(Withdrawal, returns_no_work_of_cutting) {
  double before = 0.0;
  for (const Frame& f : in_and_out_and_in().frames) {
    EXPECT_GE(f.ledger.work_cutting, before);
    before = f.ledger.work_cutting;
  }
  EXPECT_EQ(at_time(2.8).ledger.work_cutting, at_time(1.35).ledger.work_cutting);
}

TEST(Withdrawal, friction_never_gives_back) {
  double before = 0.0;
  for (const Frame& f : in_and_out_and_in().frames) {
    EXPECT_GE(f.ledger.work_friction, before - 1e-15);
    before = f.ledger.work_friction;
  }
}

TEST(Withdrawal, ends_outside_with_no_force) {
  const Frame& f = at_time(2.8);
  EXPECT_EQ(f.stage, Stage::withdrawn);
  EXPECT_EQ(f.inserted_length, 0.0);
  EXPECT_NEAR(f.hand_force, 0.0, 1e-6);
  EXPECT_TRUE(in_and_out_and_in().first(EventKind::exit));
}

TEST(Withdrawal, the_same_channel_is_not_cut_twice) {
  const double cut_before = at_time(2.8).ledger.work_cutting;
  // On the way back in, until the tip meets the channel's end again, there is friction but no cutting.
  const Frame& halfway = at_time(3.5);
  ASSERT_GT(halfway.inserted_length, 5e-3);
  EXPECT_EQ(halfway.tip_force, 0.0);
  EXPECT_EQ(halfway.ledger.work_cutting, cut_before);
  const Frame& deeper = in_and_out_and_in().frames.back();  // 30 mm: 5 mm past the first cut
  EXPECT_NEAR(deeper.ledger.work_cutting - cut_before, 0.3091 * (30e-3 - deep), 0.1 * 0.3091 * 5e-3);
  int punctures = 0;
  for (const Event& e : in_and_out_and_in().events) punctures += e.kind == EventKind::puncture;
  EXPECT_EQ(punctures, 1);
}

}  // namespace
