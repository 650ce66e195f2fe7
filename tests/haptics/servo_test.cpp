// One tick of the loop: what the coupling shows, how a slow simulation is felt, and what a broken one
// does.
#include "acus/haptics/servo.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "armed_servo.h"
#include "many_ticks.h"

namespace acus::haptics {
namespace {

// --- coupling

TEST(VirtualCoupling, is_half_as_stiff_as_sampling_and_delay_allow) {
  DeviceLimits limits = touch();
  limits.stiffness = 1e9;
  for (double delay : {0.0, 1e-3, 5e-3}) {
    limits.delay = delay;
    const VirtualCoupling coupling = coupling_for(limits, 1e-3);
    EXPECT_NEAR(coupling.stiffness, 0.5 * (limits.viscous + coupling.damping) / (0.5e-3 + delay), 1e-9);
  }
  limits.stiffness = 30.0;
  EXPECT_EQ(coupling_for(limits, 1e-3).stiffness, 30.0);  // what its maker allows
}

TEST(VirtualCoupling, is_the_grip_of_the_scene_unless_that_is_softer) {
  const double coupling = coupling_for(touch()).stiffness;
  Scene scene;
  EXPECT_EQ(scene.hand.stiffness, 0.0);  // a rigid grip
  EXPECT_EQ(held_by(touch(), scene).hand.stiffness, coupling);
  scene.hand.stiffness = 1e5;
  EXPECT_EQ(held_by(touch(), scene).hand.stiffness, coupling);
  scene.hand.stiffness = 90.0;
  EXPECT_EQ(held_by(touch(), scene).hand.stiffness, 90.0);
}

// --- the tick

TEST(Servo, shows_the_force_of_the_needle_to_a_hand_at_rest) {
  Armed loop;
  double force = 0.0;
  for (int i = 0; i < 50; ++i) force = loop.tick(5e-3, loop.fresh(3e-3, 0.7, 0.0));
  EXPECT_NEAR(force, 0.7, 1e-12);
  EXPECT_NEAR(loop.servo.hand().travel, -1e-3 + 5e-3, 1e-12);
}

// Whatever the simulation says, the hand meets no stiffer spring than the device can show, and none that
// pulls.
TEST(Servo, shows_no_stiffer_spring_than_the_coupling) {
  const auto rise_over_1_mm = [](double stiffness) {
    Armed loop;
    const LocalForce word = loop.fresh(4e-3, 0.7, stiffness);
    double before = 0.0, after = 0.0;
    for (int i = 0; i < 8; ++i) before = loop.tick(5e-3, word);
    for (int i = 0; i < 8; ++i) after = loop.tick(6e-3, word);
    return after - before;
  };
  EXPECT_NEAR(rise_over_1_mm(3e5), 1e-3 * coupling_for(touch()).stiffness, 1e-12);
  EXPECT_NEAR(rise_over_1_mm(100.0), 0.1, 1e-12);
  EXPECT_NEAR(rise_over_1_mm(-500.0), 0.0, 1e-12);
}

TEST(Servo, holds_the_hand_on_the_axis_of_the_needle) {
  Armed loop;
  for (int i = 0; i < 50; ++i) loop.tick(0.0, loop.fresh(-1e-3, 0.0, 0.0), Vec3(1e-3, 0.0, 0.0));
  EXPECT_NEAR(loop.last.x(), -1e-3 * loop.servo.coupling().stiffness, 1e-12);
}

// A simulation at 50 Hz: between its words the force follows the hand by the tangent, and a word that
// corrects it is blended in, with no step larger than a hundredth of what changes.
TEST(Servo, is_continuous_between_the_words_of_a_slow_simulation) {
  Armed loop;
  LocalForce word = loop.fresh(0.0, 0.0, 50.0);
  double before = 0.0, largest_step = 0.0;
  for (int i = 0; i < 400; ++i) {
    const double way = 1e-3 + 10e-3 * i * 1e-3;  // 10 mm/s
    // The needle is a spring of 60 N/m, the word says 50: each word corrects the force by some 2 mN.
    if (i % 20 == 0) word = loop.fresh(loop.servo.hand().travel, 60.0 * loop.servo.hand().travel, 50.0);
    const double force = loop.tick(way, word);
    if (i > 40) largest_step = std::max(largest_step, std::abs(force - before));
    before = force;
  }
  EXPECT_LT(largest_step, 1e-3);
  EXPECT_NEAR(before, 60.0 * loop.servo.hand().travel, 3e-3);
}

TEST(Servo, lets_the_drop_of_a_puncture_through_within_two_ticks) {
  Armed loop;
  for (int i = 0; i < 50; ++i) loop.tick(10e-3, loop.fresh(8e-3, 1.0, 0.0));
  const LocalForce punctured = loop.fresh(8e-3, 0.3, 0.0, 1);
  loop.tick(10e-3, punctured);
  EXPECT_NEAR(loop.tick(10e-3, punctured), 0.3, 1e-12);
}

// What the gate holds while a word is late is the needle's force, without the answer to the one quantum that
// the device has just gone.
TEST(Servo, leaves_no_answer_to_a_quantum_in_a_force_that_is_held) {
  Armed loop;
  LocalForce word;
  for (int i = 0; i < 50; ++i) word = loop.fresh(3e-3, 0.7, 0.0), loop.tick(5e-3, word);
  for (int i = 0; i < 18; ++i) loop.tick(5e-3, word);
  const double quantum = touch().quantum;
  loop.velocity = quantum / 1e-3 * touch().forward;  // in the last tick that is followed
  loop.tick(5e-3 + quantum, word);
  loop.velocity.setZero();
  double force = 0.0;
  for (int i = 0; i < 7; ++i) force = loop.tick(5e-3 + quantum, word);
  EXPECT_GE(loop.servo.gate().interventions().held, 5);
  EXPECT_NEAR(force, 0.7, 1e-12);
}

// A word every 33 ms, of which the gate follows 20: the friction that a spring of 300 N/m wants then, twice
// K h^2 / (2 f), is felt as that much of a push for a quantum's way. What it takes is not there to be given
// back.
TEST(Servo, answers_for_what_a_held_force_gives) {
  Armed loop;
  constexpr double stiffness = 300.0;
  const double quantum = touch().quantum;
  double push = 0.0;  // N s
  LocalForce word;
  for (int i = 0; i < 3 * 33 + 15; ++i) {
    if (i % 33 == 0) word = loop.fresh(3e-3, 0.7, stiffness);
    const double way = i > 3 * 33 ? quantum : 0.0;
    const double beyond = loop.tick(5e-3 + way, word) - (0.7 + stiffness * (1e-3 + way));
    if (i > 3 * 33) push += beyond * 1e-3;
  }
  EXPECT_NEAR(push, stiffness * std::pow(33e-3 - followed_age, 2) / followed_age * quantum, 0.05 * push);
  const double before = loop.servo.hand().work;
  loop.tick(5e-3 + 2.0 * quantum, word);
  const double needle = 0.7 + stiffness * (1e-3 + quantum);
  EXPECT_NEAR(loop.servo.hand().work - before, quantum * needle, 1e-6 * quantum * needle);
}

TEST(Servo, shows_no_more_of_the_needle_than_the_coupling_would_hold) {
  Armed loop;
  double force = 0.0;
  for (int i = 0; i < 50; ++i) force = loop.tick(0.0, loop.fresh(-1e-3, 3.2, 0.0));
  const double stiffness = loop.servo.coupling().stiffness;
  EXPECT_NEAR(force, std::sqrt(2.0 * stiffness * loop.servo.hand().work), 1.1 * stiffness * touch().quantum);
  EXPECT_GT(loop.servo.lowered(), 40);
}

TEST(Servo, shows_nothing_before_the_simulation_has_spoken_or_the_device_is_ready) {
  Servo servo({touch(), 0.0, 0.0, 1e-3});
  DeviceState state;
  for (int i = 0; i < 2000; ++i) {
    state.time = i * 1e-3;
    state.ready = i > 1000;
    state.position = Vec3(0.0, 0.0, -1e-3 * i);
    ASSERT_EQ(servo.tick(state, LocalForce{}).force, Vec3(Vec3::Zero()));
  }
  EXPECT_EQ(servo.gate().fault(), GateFault::none);
}

TEST(Servo, is_at_zero_within_100_ms_of_the_simulations_last_word) {
  Armed loop;
  const auto grown_old = [&](int ms) {
    Armed one;
    LocalForce word;
    for (int i = 0; i < 50; ++i) word = one.fresh(8e-3, 2.0, 0.0), one.tick(10e-3, word);
    double force = 0.0;
    for (int i = 0; i < ms; ++i) force = one.tick(10e-3, word);
    return force;
  };
  EXPECT_NEAR(grown_old(19), 2.0, 1e-12);
  EXPECT_EQ(grown_old(99), 0.0);
}

// Whenever the simulation falls silent, however fast it had spoken and whatever the hand does meanwhile.
TEST(Servo, is_at_zero_within_100_ms_in_a_thousand_stalls) {
  std::mt19937 random(11);
  const auto any = [&](double low, double high) {
    return low + (high - low) * (static_cast<double>(random()) / 4294967296.0);
  };
  int felt = 0;
  for (int trial = 0; trial < 1000; ++trial) {
    Armed loop;
    const int period = 1 + static_cast<int>(random() % 33);
    const double stiffness = any(10.0, 400.0), swing = any(1e-3, 5e-3), rate = any(5.0, 40.0);
    const int stall = 200 + static_cast<int>(random() % 300);
    LocalForce word;
    double when_silent = 0.0, force = 0.0, way = 0.0;
    for (int i = 0; i < stall + 100; ++i) {
      if (i < stall && i % period == 0) {
        word = loop.fresh(loop.servo.hand().travel, stiffness * (way + 2e-3), stiffness);
        when_silent = i;
      }
      way = swing * (1.0 - std::cos(rate * i * 1e-3));
      force = loop.tick(way, word);
      felt += i == stall - 1 && force > 0.05;
      if (i - when_silent >= 100) {
        ASSERT_EQ(force, 0.0) << "trial " << trial << ", " << i - when_silent << " ms after the last word";
      }
    }
  }
  EXPECT_GT(felt, 500);
}

// What is no number, from either side, turns the force off and leaves the hand where it was.
TEST(Servo, never_tells_the_simulation_a_number_that_is_none) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  for (int which = 0; which < 4; ++which) {
    Armed loop;
    LocalForce word = loop.fresh(0.0, 0.5, 10.0);
    double way = 2e-3;
    (which == 0 ? way : which == 1 ? word.force : which == 2 ? word.stiffness : word.travel) = nan;
    const double force = loop.tick(way, word);
    EXPECT_TRUE(std::isfinite(force)) << which;
    EXPECT_TRUE(std::isfinite(loop.servo.hand().travel)) << which;
    EXPECT_EQ(loop.servo.gate().fault(), GateFault::not_finite) << which;
  }
}

// Every number that comes in is now and then none, infinite or absurd. What goes out is finite and within the
// limit in every tick, and once all is well and somebody rearms the gate, the needle is felt again.
TEST(Servo, stands_a_million_ticks_of_broken_numbers_at_every_interface) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN(),
                   inf = std::numeric_limits<double>::infinity();
  const double oddities[] = {nan, inf, -inf, 1e300, -1e300};
  Servo servo({touch(), 0.0, 0.0, 1e-3});
  std::mt19937 random(3);
  long felt = 0, faults = 0;
  for (long i = 0; i < many_ticks; ++i) {
    const double t = static_cast<double>(i) * 1e-3;
    DeviceState state;
    state.time = t;
    state.position = Vec3(0.0, 0.0, -2.5e-3 * (1.0 - std::cos(t)));
    state.ready = true;
    const double travel = servo.hand().travel;
    LocalForce word{t, travel, 100.0 * std::max(travel, 0.0), 100.0, 5e-3};
    word.stored = 1.0;
    if (i % 1000 == 999) {
      double* const fields[] = {&state.time,  &state.position.x(), &state.position.z(), &state.velocity.y(),
                                &word.time,   &word.travel,        &word.force,         &word.stiffness,
                                &word.radius, &word.stored,        &word.taken};
      *fields[random() % std::size(fields)] = oddities[random() % std::size(oddities)];
    }
    const Wrench out = servo.tick(state, word);
    ASSERT_TRUE(out.force.allFinite() && out.torque.allFinite()) << i;
    ASSERT_LE(out.force.norm(), touch().peak_force * (1.0 + 1e-15)) << i;
    ASSERT_TRUE(std::isfinite(servo.hand().travel)) << i;
    felt += out.force.norm() > 0.1;
    if (servo.gate().fault() != GateFault::none) ++faults, servo.rearm();
  }
  EXPECT_GT(faults, many_ticks / 4000);
  EXPECT_GT(felt, many_ticks / 10);
}

// The guide is a spring: it needs no energy of the needle's, and takes none from it.
TEST(Servo, holds_the_hand_across_before_it_has_touched_anything) {
  Armed loop;
  const double before = loop.servo.hand().work;
  for (int i = 0; i < 100; ++i) {
    LocalForce word = loop.fresh(-1e-3, 0.0, 0.0);
    word.stored = 0.0;
    loop.tick(0.0, word, Vec3(1e-5 * std::min(i, 50), 0.0, 0.0));
  }
  EXPECT_NEAR(loop.last.x(), -0.5e-3 * loop.servo.coupling().stiffness, 1e-12);
  EXPECT_NEAR(loop.servo.hand().work, before, 1e-12);
}

TEST(Servo, begins_where_the_device_first_says_a_place) {
  Servo servo({touch(), 0.0, -5e-3, 1e-3});
  DeviceState state;
  state.ready = true;
  state.position = Vec3(std::nan(""), 0.0, 0.0);
  servo.tick(state, LocalForce{});
  state.position = Vec3(0.1, 0.2, 0.3);
  servo.tick(state, LocalForce{0.0, 0.0, 0.0, 0.0, 1.0});
  EXPECT_EQ(servo.hand().travel, -5e-3);
  servo.rearm();
  state.position -= Vec3(0.0, 0.0, 2e-3);
  servo.tick(state, LocalForce{0.0, 0.0, 0.0, 0.0, 1.0});
  EXPECT_NEAR(servo.hand().travel, -3e-3, 1e-12);
}

TEST(Servo, leaves_the_needle_where_it_is_when_the_device_jumps) {
  for (double far : {0.3, -0.3, 1e300}) {
    Armed loop;
    loop.tick(1e-3, loop.fresh(0.0, 0.0, 0.0));
    const double travel = loop.servo.hand().travel;
    loop.tick(far, loop.fresh(0.0, 0.0, 0.0));
    EXPECT_NEAR(loop.servo.hand().travel, travel, 1e-12);
    EXPECT_EQ(loop.servo.gate().fault(), GateFault::over_speed);
    loop.tick(1e-3, loop.fresh(0.0, 0.0, 0.0));
    loop.tick(2e-3, loop.fresh(0.0, 0.0, 0.0));
    EXPECT_NEAR(loop.servo.hand().travel, travel + 1e-3, 1e-12);
  }
}

// A handle that was calibrated again tells other coordinates: the needle stays, and the force comes as at the
// start.
TEST(Servo, begins_anew_when_the_device_is_ready_again) {
  Armed loop;
  for (int i = 0; i < 50; ++i) loop.tick(1e-3, loop.fresh(0.0, 2.0, 0.0));
  EXPECT_NEAR(loop.last.norm(), 2.0, 1e-12);
  const double travel = loop.servo.hand().travel;
  loop.ready = false;
  for (int i = 0; i < 300; ++i) loop.tick(1e-3, loop.fresh(0.0, 2.0, 0.0));
  loop.ready = true;
  for (int i = 0; i < 50; ++i) {
    EXPECT_EQ(loop.tick(40e-3, loop.fresh(0.0, 2.0, 0.0)), 0.0);
    EXPECT_NEAR(loop.servo.hand().travel, travel, 1e-12);
  }
}

TEST(Servo, lets_go_by_the_slew) {
  Armed loop;
  for (int i = 0; i < 50; ++i) loop.tick(1e-3, loop.fresh(0.0, 2.5, 0.0));
  loop.servo.let_go();
  EXPECT_NEAR(loop.tick(1e-3, loop.fresh(0.0, 2.5, 0.0)), 1.5, 1e-12);
  EXPECT_NEAR(loop.tick(1e-3, loop.fresh(0.0, 2.5, 0.0)), 0.5, 1e-12);
  EXPECT_EQ(loop.tick(1e-3, loop.fresh(0.0, 2.5, 0.0)), 0.0);
}

TEST(Servo, obeys_the_smaller_of_the_persons_limit_and_the_devices) {
  for (double limit : {0.5, 100.0}) {
    Servo servo({touch(), limit, 0.0, 1e-3});
    DeviceState state;
    state.ready = true;
    double force = 0.0;
    for (int i = 0; i < 900; ++i) {
      state.time = i * 1e-3;
      state.position = Vec3(0.0, 0.0, -0.1e-3 * std::max(i - 600, 0));
      force = servo.tick(state, {state.time, 0.0, 0.0, 1e4, 1.0}).force.norm();
    }
    EXPECT_NEAR(force, std::min(limit, touch().peak_force), 1e-12);
  }
}

}  // namespace
}  // namespace acus::haptics
