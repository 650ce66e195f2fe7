// What may be given to a hand, and what is taken back.
#include "acus/haptics/passivity_layer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "acus/haptics/handle.h"

namespace acus::haptics {
namespace {

constexpr double tick = 1e-3;        // s
constexpr double stiffness = 400.0;  // N/m, of the coupling

DeviceLimits some_device(double delay = 0.0) {
  DeviceLimits limits;
  limits.mass = 0.1;
  limits.quantum = 0.05e-3;
  limits.delay = delay;
  return limits;
}

// Pushes 1 mm far against `force` [N], in ten ticks.
void push(PassivityLayer& layer, double force) {
  for (int i = 0; i < 10; ++i) layer.moved(0.1e-3, force);
}

// The trapezoid of force over way, but for the quantum in which the hand turns round.
TEST(PassivityLayer, counts_what_the_hand_does_to_the_device) {
  PassivityLayer layer(some_device(), stiffness, tick);
  push(layer, 2.0);
  EXPECT_NEAR(layer.work(), 0.95e-3 * 2.0, 1e-12);
  for (int i = 0; i < 5; ++i) layer.moved(-0.1e-3, 1.0);
  EXPECT_NEAR(layer.work(), 1.9e-3 - 0.05e-3 * 1.5 - 0.4e-3 * 1.0, 1e-12);
}

// An encoder shows a slow motion in one tick of many: the force of all of them counts.
TEST(PassivityLayer, counts_the_mean_force_of_a_motion_that_shows_late) {
  PassivityLayer layer(some_device(), stiffness, tick);
  for (int i = 1; i <= 10; ++i) layer.moved(i % 10 == 0 ? 0.05e-3 : 0.0, i % 2 == 0 ? 1.0 : 0.0);
  const double before = layer.work();
  for (int i = 1; i <= 20; ++i) layer.moved(i % 10 == 0 ? 0.05e-3 : 0.0, i % 2 == 0 ? 1.0 : 0.0);
  EXPECT_NEAR(layer.work() - before, 2 * 0.05e-3 * 0.5, 1e-12);
}

TEST(PassivityLayer, counts_a_force_when_it_is_shown_and_not_when_it_is_told) {
  PassivityLayer layer(some_device(2e-3), stiffness, tick);
  layer.moved(0.1e-3, 1.0);
  layer.moved(0.1e-3, 0.0);
  EXPECT_EQ(layer.work(), 0.0);
  layer.moved(0.1e-3, 0.0);
  layer.moved(0.1e-3, 0.0);
  EXPECT_NEAR(layer.work(), 0.1e-3, 1e-12);
}

// A handle that hums for an hour over the edge of a quantum, a spring's force to and fro, has gone nowhere.
// Where forces are held it pays for each crossing, K times a quantum squared for both ways.
TEST(PassivityLayer, counts_a_hum_between_two_quanta_as_no_way) {
  const double quantum = some_device().quantum;
  const auto work_of_crossings = [&](bool held_between) {
    PassivityLayer layer(some_device(), stiffness, tick);
    push(layer, 2.0);
    layer.moved(quantum, 2.0, held_between);
    const double before = layer.work();
    for (int i = 0; i < 1000; ++i) {
      layer.moved(-quantum, 2.0 + stiffness * quantum, held_between);
      layer.moved(quantum, 2.0, held_between);
    }
    return layer.work() - before;
  };
  EXPECT_EQ(work_of_crossings(false), 0.0);
  EXPECT_NEAR(work_of_crossings(true), -1000 * stiffness * quantum * quantum, 1e-9);
}

TEST(PassivityLayer, allows_what_the_tank_can_pay_for) {
  PassivityLayer layer(some_device(), stiffness, tick);
  layer.moved(0.1e-3, 2.0);
  const double filled = 0.1e-3;                                            // J
  EXPECT_EQ(layer.ceiling(1.0), std::numeric_limits<double>::infinity());  // against the motion
  EXPECT_NEAR(layer.ceiling(-1.0), filled / 0.15e-3, 1e-9);  // with it: a tick's way and a quantum
  layer.moved(0.0, 1.0);
  EXPECT_NEAR(layer.ceiling(1.0), filled / 0.05e-3, 1e-9);  // at rest: a quantum
  PassivityLayer empty(some_device(), stiffness, tick);
  empty.moved(-0.1e-3, 1.0);
  EXPECT_EQ(empty.ceiling(1.0), 0.0);
}

// A tank that runs empty lets go as the coupling's spring would, and no stiffer: what the hand gets is F^2 /
// (2 K).
TEST(PassivityLayer, lets_go_like_a_spring_of_the_couplings_stiffness) {
  DeviceLimits limits = some_device();
  limits.quantum = 1e-6;  // finer than what is looked at
  PassivityLayer layer(limits, stiffness, tick);
  push(layer, 2.0);
  layer.moved(0.0, 2.0);
  const double filled = layer.work(), strongest = layer.soft_ceiling(1.0);
  EXPECT_NEAR(strongest, std::sqrt(2.0 * stiffness * filled), 2.0 * stiffness * limits.quantum);
  constexpr double step = 1e-6;  // m, back
  for (int i = 1; layer.soft_ceiling(1.0) > 0.1; ++i) {
    const double force = layer.soft_ceiling(1.0);
    EXPECT_NEAR(force, strongest - stiffness * step * i, 0.01 * strongest);
    EXPECT_LE(force, layer.ceiling(1.0));
    layer.moved(-step, force);
  }
}

// One that starts from nothing lets the force grow against the hand, or no hand would ever feel a needle.
TEST(PassivityLayer, lets_an_empty_tank_be_filled) {
  PassivityLayer layer(some_device(), stiffness, tick);
  double travel = 0.0;
  for (int i = 0; i < 100; ++i) {
    layer.moved(0.1e-3, layer.soft_ceiling(1.0));
    travel += 0.1e-3;
  }
  EXPECT_GE(layer.soft_ceiling(1.0), stiffness * travel);
}

TEST(PassivityLayer, gives_back_no_more_than_is_stored_and_forgets_that_slowly) {
  PassivityLayer layer(some_device(), stiffness, tick);
  push(layer, 2.0);
  layer.moved(0.0, 0.0);
  layer.compare(layer.work(), 0.0, 0.0, 0.4e-3);
  EXPECT_NEAR(layer.ceiling(1.0), 0.4e-3 / 0.05e-3, 1e-9);
  layer.compare(layer.work(), 0.0, 0.0, 5e-3);  // more than the hand put in is not there to give
  EXPECT_NEAR(layer.ceiling(1.0), 0.4e-3 / 0.05e-3, 1e-9);
  for (int i = 0; i < 200; ++i) layer.moved(0.0, 0.0);  // 1 mW
  EXPECT_NEAR(layer.ceiling(1.0), 0.6e-3 / 0.05e-3, 1e-9);
}

// The damper takes back what was given, but for the little that is forgiven meanwhile, and no faster than 5 N
// s/m.
TEST(PassivityLayer, takes_back_what_wrong_guesses_gave) {
  PassivityLayer layer(some_device(), stiffness, tick);
  for (int i = 0; i < 100; ++i) EXPECT_EQ(layer.damping_force(0.1), 0.0);  // nothing is owed
  layer.compare(0.0, 1.0e-3, 1.2e-3, 1.0);
  double taken = 0.0, largest = 0.0;
  for (int i = 0; i < 60; ++i) {
    const double force = layer.damping_force(0.1);
    taken += force * 0.1 * tick;
    largest = std::max(largest, force);
  }
  EXPECT_NEAR(largest, 0.5, 1e-6);
  EXPECT_NEAR(taken, 0.2e-3, 0.005e-3);
  EXPECT_EQ(layer.damping_force(0.1), 0.0);
  layer.compare(0.0, 3.0e-3, 1.2e-3, 1.0);  // it asked too much: nothing is owed
  EXPECT_EQ(layer.damping_force(0.1), 0.0);
}

// What the damper takes from a hand that goes at 0.1 m/s for `ticks`. J
double taken_back(PassivityLayer& layer, int ticks) {
  double taken = 0.0;
  for (int i = 0; i < ticks; ++i) taken += layer.damping_force(0.1) * 0.1 * tick;
  return taken;
}

TEST(PassivityLayer, takes_back_no_more_than_is_owed) {
  PassivityLayer layer(some_device(), stiffness, tick);
  taken_back(layer, 100);  // the speed is known now
  layer.compare(0.0, 0.0, 0.12e-3, 1.0);
  EXPECT_NEAR(taken_back(layer, 10), 0.12e-3, 0.002e-3);  // in two ticks and a half, but for what is forgiven
}

// A needle that took a joule at once is another needle.
TEST(PassivityLayer, takes_back_no_more_than_a_swing_holds) {
  PassivityLayer layer(some_device(), stiffness, tick);
  taken_back(layer, 100);
  layer.compare(0.0, 0.0, 1.0, 1.0);
  const double taken = taken_back(layer, 500);
  EXPECT_GT(taken, 1.0e-3);
  EXPECT_LE(taken, 2.0e-3);
}

TEST(PassivityLayer, gives_a_hand_that_was_asked_too_much_no_credit) {
  PassivityLayer layer(some_device(), stiffness, tick);
  taken_back(layer, 100);
  layer.compare(0.0, 1.0e-3, 0.0, 1.0);
  layer.compare(0.0, 1.0e-3, 0.2e-3, 1.0);
  EXPECT_NEAR(taken_back(layer, 100), 0.2e-3, 0.01e-3);
}

TEST(PassivityLayer, forgives_a_hand_that_came_to_rest) {
  PassivityLayer layer(some_device(), stiffness, tick);
  layer.compare(0.0, 0.0, 0.2e-3, 1.0);
  for (int i = 0; i < 2000; ++i) layer.damping_force(0.0);
  EXPECT_LT(taken_back(layer, 100), 1e-7);
}

// A word that says nonsense about what is stored empties the tank, and does not keep it empty for ever.
TEST(PassivityLayer, takes_no_needle_to_hold_less_than_nothing) {
  PassivityLayer layer(some_device(), stiffness, tick);
  push(layer, 2.0);
  layer.compare(layer.work(), 0.0, 0.0, -5.0);
  for (int i = 0; i < 200; ++i) layer.moved(0.0, 0.0);  // 1 mW
  EXPECT_NEAR(layer.ceiling(1.0), 0.2e-3 / 0.05e-3, 1e-9);
}

TEST(PassivityLayer, counts_no_force_that_no_hand_has) {
  PassivityLayer layer(some_device(), stiffness, tick);
  for (double travel : {0.0, 1e-3}) layer.felt(travel, 1e9);
  EXPECT_NEAR(layer.felt_work(), 1e-3 * 100.0, 1e-12);
}

// Only so many forces are remembered: of a device that is slower still the oldest of them counts.
TEST(PassivityLayer, remembers_fifteen_ticks_of_a_longer_delay) {
  PassivityLayer layer(some_device(20e-3), stiffness, tick);
  for (int i = 0; i < 15; ++i) layer.moved(0.1e-3, i == 0 ? 1.0 : 0.0);
  EXPECT_EQ(layer.work(), 0.0);
  layer.moved(0.1e-3, 0.0);
  EXPECT_NEAR(layer.work(), 0.05e-3, 1e-12);  // half of it belongs to the tick after
  layer.moved(0.1e-3, 0.0);
  EXPECT_NEAR(layer.work(), 0.1e-3, 1e-12);
}

// A force that drives every motion on is as wrong as a guess can be. Without the ceiling it gives the hand
// millijoules; with it, nothing.
TEST(PassivityLayer, keeps_the_worst_guess_from_giving_energy) {
  const auto least_energy = [](bool limited, double delay) {
    const DeviceLimits limits = some_device(delay);
    PassivityLayer layer(limits, stiffness, tick);
    Handle handle(limits, {0.1, 1.0, 50.0});
    double before = 0.0, told = 0.0;
    double least = 0.0;
    for (int i = 0; i < 5000; ++i) {
      const double step = handle.encoder().x() - before;
      before = handle.encoder().x();
      layer.moved(step, told);
      double force = std::clamp(-10.0 * step / tick, -3.0, 3.0);  // N, a damper of the wrong sign
      const double ceiling = layer.ceiling(force);
      if (limited) force = std::clamp(force, -ceiling, ceiling);
      told = force;
      handle.command({-force, 0.0, 0.0});
      const double t = i * tick;
      handle.advance_to((i + 1) * tick,
                        {{5e-3 * std::sin(7.0 * t), 0.0, 0.0}, {35e-3 * std::cos(7.0 * t), 0.0, 0.0}});
      least = std::min(least, handle.port_energy());
    }
    return least;
  };
  for (double delay : {0.0, 1e-3}) {
    EXPECT_LT(least_energy(false, delay), -1e-3);
    EXPECT_GE(least_energy(true, delay), -1e-6);
  }
}

TEST(PassivityLayer, is_not_spoilt_by_numbers_that_are_none) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  for (double bad : {nan, std::numeric_limits<double>::infinity(), -1e300, 1e300}) {
    PassivityLayer layer(some_device(), stiffness, tick);
    push(layer, 2.0);
    layer.felt(0.0, 1.0);
    layer.felt(bad, 1.0);
    layer.felt(0.0, bad);
    layer.felt(0.0, 1.0);
    layer.moved(bad, 0.0);
    layer.compare(bad, 0.0, 0.0, 1.0);
    layer.compare(0.0, bad, 0.0, 1.0);
    layer.compare(0.0, 0.0, bad, 1.0);
    layer.damping_force(bad);
    EXPECT_TRUE(std::isfinite(layer.work()) && std::isfinite(layer.felt_work())) << bad;
    push(layer, 2.0);
    layer.compare(layer.work(), layer.felt_work(), 0.0, 1.0);
    EXPECT_GT(layer.work(), 1e-3) << bad;
    EXPECT_TRUE(std::isfinite(layer.damping_force(0.1))) << bad;
    for (int i = 0; i < 5000; ++i) layer.moved(0.0, 0.0);
    EXPECT_GT(layer.ceiling(1.0), 10.0) << bad;
  }
}

}  // namespace
}  // namespace acus::haptics
