// The guards of the tick that only a particular history shows. (guards.py takes each out.)
#include <cmath>

#include "armed_servo.h"

namespace acus::haptics {
namespace {

// A clock may begin anywhere, and what stands in the mailbox before the first word is no word.
TEST(Servo, shows_nothing_of_a_word_that_was_not_spoken_whatever_the_clock_says) {
  Servo servo({touch(), 0.0, 0.0, 1e-3});
  DeviceState state;
  state.ready = true;
  LocalForce nothing_yet;
  nothing_yet.force = 0.1;
  nothing_yet.stored = 1.0;
  for (int i = 0; i < 2000; ++i) {
    state.time = -3.0 + i * 1e-3;
    state.position.z() = -1e-5 * i;  // against the force, which needs no energy then
    ASSERT_EQ(servo.tick(state, nothing_yet).force, Vec3(Vec3::Zero())) << i;
  }
}

TEST(Servo, shows_nothing_to_a_device_that_is_not_ready) {
  Servo servo({touch(), 0.0, 0.0, 1e-3});
  DeviceState state;
  LocalForce word;
  word.force = 0.1;
  word.stored = 1.0;
  for (int i = 0; i < 1000; ++i) {
    word.time = state.time = i * 1e-3;
    state.position.z() = -1e-5 * i;
    ASSERT_EQ(servo.tick(state, word).force, Vec3(Vec3::Zero())) << i;
  }
}

// A simulation at 50 Hz: the correction of such a word takes 5 ms, a puncture no time but the slew's.
TEST(Servo, does_not_fade_in_a_puncture_that_a_slow_simulation_tells) {
  Armed loop;
  const LocalForce before = loop.fresh(8e-3, 1.0, 0.0);
  for (int i = 0; i < 20; ++i) loop.tick(5e-3, before);
  EXPECT_NEAR(loop.tick(5e-3, loop.fresh(8e-3, 0.3, 0.0, 1)), 0.3, 1e-12);
}

// The needle holds nothing any more, says the word, and yet it pushes the hand out.
TEST(Servo, gives_no_energy_that_is_not_stored) {
  Armed loop;
  LocalForce word = loop.fresh(0.0, 0.0, 0.0);
  for (int i = 0; i < 20; ++i) {
    word = loop.fresh(0.0, 1.0, 0.0);
    word.stored = 0.0;
    word.hand = loop.servo.hand();
    loop.tick(-0.1e-3 * i, word);
  }
  EXPECT_LT(std::abs(loop.last.norm()), 0.05);
  EXPECT_GT(loop.servo.lowered(), 10);
}

// 2 mJ are left when the simulation falls silent: enough to hold 1 N, and no more than that is given to a
// hand that goes back.
TEST(Servo, gives_no_energy_that_is_not_stored_while_it_holds_a_force) {
  Armed loop;
  constexpr double stored = 2e-3, back = 0.4e-3;  // J; m a tick
  LocalForce word = loop.fresh(0.0, 0.0, 0.0);
  for (int i = 0; i < 20; ++i) {
    word = loop.fresh(0.0, 1.0, 0.0);
    word.stored = stored;
    word.hand = loop.servo.hand();
    loop.tick(0.0, word);
  }
  EXPECT_NEAR(loop.last.norm(), 1.0, 1e-12);
  for (int i = 1; i <= 25; ++i) loop.tick(0.0, word);
  EXPECT_NEAR(loop.last.norm(), 1.0, 1e-12);  // held
  double given = 0.0;                         // J
  for (int i = 1; i <= 10; ++i) {
    given += loop.last.norm() * back;
    loop.tick(-back * i, word);
  }
  // What the layer lets come back in 35 ms at 1 mW, and what a quantum may hide under 1 N.
  EXPECT_LE(given, stored + 35e-6 + 1.0 * touch().quantum);
  EXPECT_EQ(loop.servo.gate().fault(), GateFault::none);
}

// The needle took 1 mJ more of the hand than the hand has felt: at 50 mm/s the damper asks 5 N s/m for it.
TEST(Servo, asks_back_what_wrong_guesses_gave) {
  const auto force_with_debt = [](double debt) {
    Armed loop;
    loop.velocity = Vec3(0.0, 0.0, -50e-3);
    double force = 0.0;
    for (int i = 0; i < 40; ++i) {
      LocalForce word = loop.fresh(0.0, 0.5, 0.0);
      word.hand = loop.servo.hand();
      word.taken = word.hand.felt + debt;
      force = loop.tick(50e-6 * i, word);
    }
    return force;
  };
  EXPECT_NEAR(force_with_debt(1e-3) - force_with_debt(0.0), 5.0 * 50e-3, 1e-3);
}

// Held at 30 ms of age, and told to let go: not after another 20 ms, but now.
TEST(Servo, lets_go_at_once_of_a_force_that_it_holds) {
  Armed loop;
  LocalForce word;
  for (int i = 0; i < 20; ++i) word = loop.fresh(0.0, 2.5, 0.0), loop.tick(1e-3, word);
  for (int i = 0; i < 30; ++i) loop.tick(1e-3, word);
  EXPECT_NEAR(loop.last.norm(), 2.5, 1e-12);
  loop.servo.let_go();
  for (double expected : {1.5, 0.5, 0.0}) EXPECT_NEAR(loop.tick(1e-3, word), expected, 1e-12);
}

}  // namespace
}  // namespace acus::haptics
