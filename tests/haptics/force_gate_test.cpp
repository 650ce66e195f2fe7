// What the force gate lets through, and how fast: arming, slew, peak, ceiling, torques. The figures are those
// of the design: each test goes red when its guard is taken out.
#include "driven_gate.h"

namespace acus::haptics {
namespace {

// --- arming

TEST(ForceGate, gives_nothing_to_a_command_that_was_never_quiet) {
  Driven d;
  for (int i = 0; i < 3000; ++i) ASSERT_EQ(d.ask(1.0), 0.0);
  EXPECT_EQ(d.gate.state(), GateState::disarmed);
  EXPECT_EQ(d.gate.interventions().disarmed, 3000);
}

TEST(ForceGate, arms_after_four_quiet_ticks_in_a_row) {
  Driven three;
  for (int i = 0; i < 50; ++i) {
    three.ask_for(3, 0.199);
    three.ask(0.201);
  }
  EXPECT_EQ(three.gate.state(), GateState::disarmed);
  Driven four;
  four.ask_for(3, 0.199);
  EXPECT_EQ(four.gate.state(), GateState::disarmed);
  four.ask(0.199);
  EXPECT_EQ(four.gate.state(), GateState::ramping);
}

TEST(ForceGate, is_quiet_only_below_a_fifth_of_a_newton) {
  Driven at_the_limit, under_it;
  at_the_limit.ask_for(100, 0.2);
  under_it.ask_for(100, std::nextafter(0.2, 0.0));
  EXPECT_EQ(at_the_limit.gate.state(), GateState::disarmed);
  EXPECT_EQ(under_it.gate.state(), GateState::ramping);
}

TEST(ForceGate, ramps_evenly_over_half_a_second) {
  Driven d;
  d.ask_for(4, 0.0);
  for (int i = 1; i <= 500; ++i) {
    ASSERT_NEAR(d.ask(1.0), i / 500.0, 1e-9);
    if (i < 500) {
      ASSERT_EQ(d.gate.state(), GateState::ramping) << i;
    }
  }
  d.ask(1.0);  // the last bit of the share
  EXPECT_EQ(d.gate.state(), GateState::armed);
  EXPECT_EQ(d.ask(1.0), 1.0);
}

TEST(ForceGate, does_not_count_ticks_as_quiet_while_something_is_wrong) {
  Driven fast, old, hot({8.5, 0.0, 0.0});
  for (int i = 0; i < 100; ++i) {
    fast.ask(0.0, 0.0, 1.3);
    old.ask(0.0, 0.021);
    old.ask(0.0), old.ask(0.0), old.ask(0.0);
  }
  EXPECT_EQ(fast.gate.state(), GateState::disarmed);
  EXPECT_EQ(old.gate.state(), GateState::disarmed);
  // A hand that moves fast, or a simulation that is not there yet, is no fault before any force is on.
  EXPECT_EQ(fast.gate.fault(), GateFault::none);
  fast.armed();
}

// --- slew and peak

TEST(ForceGate, rises_by_half_a_newton_and_falls_by_a_whole_one_per_millisecond) {
  Driven d;
  d.armed();
  for (double expected : {0.5, 1.0, 1.5, 2.0, 2.5, 2.75}) ASSERT_DOUBLE_EQ(d.ask(2.75), expected);
  for (double expected : {1.75, 0.75, 0.0}) ASSERT_DOUBLE_EQ(d.ask(0.0), expected);
  EXPECT_EQ(d.gate.interventions().slew, 7);
}

TEST(ForceGate, lets_the_drop_of_a_puncture_through_within_two_ticks) {
  Driven d;
  d.at(1.0);
  EXPECT_DOUBLE_EQ(d.ask(0.3), 0.3);
}

TEST(ForceGate, turns_a_force_around_by_the_same_slew) {
  Driven d;
  d.at(2.0);
  Triple last = x(2.0);
  for (int i = 0; i < 20; ++i) {
    const Triple now = d.ask({-1.0, 1.5, 0.0});
    ASSERT_LE(std::hypot(now[0] - last[0], now[1] - last[1]), 1.0 + 1e-12);
    last = now;
  }
  EXPECT_EQ(last, (Triple{-1.0, 1.5, 0.0}));
  d.at(2.0);
  EXPECT_NEAR(d.ask({0.0, 2.0, 0.0})[1], std::sqrt(0.5), 1e-12);  // no larger than it was: not a rise
}

TEST(ForceGate, gives_a_late_tick_no_more_than_a_millisecond_and_an_early_one_its_part) {
  Driven d;
  d.armed();
  EXPECT_DOUBLE_EQ(d.gate.pass({x(5.0), {}, {}, 0.0, 5e-3}).force[0], 0.5);
  EXPECT_DOUBLE_EQ(d.gate.pass({x(5.0), {}, {}, 0.0, 0.25e-3}).force[0], 0.625);
  EXPECT_DOUBLE_EQ(d.gate.pass({x(5.0), {}, {}, 0.0, 0.0}).force[0], 0.625);
  EXPECT_DOUBLE_EQ(d.gate.pass({x(5.0), {}, {}, 0.0, -1.0}).force[0], 0.625);
}

TEST(ForceGate, clamps_the_norm_and_keeps_the_direction) {
  Driven d({2.0, 2.0, 0.0});
  d.armed();
  Triple last{};
  for (int i = 0; i < 50; ++i) last = d.ask({30.0, -40.0, 0.0});
  EXPECT_NEAR(last[0], 1.2, 1e-12);
  EXPECT_NEAR(last[1], -1.6, 1e-12);
  EXPECT_LE(norm(last), 2.0 + 1e-15);
  EXPECT_EQ(d.gate.interventions().peak, 50);
}

TEST(ForceGate, gives_nothing_where_a_limit_is_no_limit) {
  for (double bad : {0.0, -1.0, nan, infinity}) {
    Driven d({bad, 1.0, 1.0}), hot({5.0, bad, 1.0});
    for (int i = 0; i < 700; ++i) ASSERT_EQ(d.ask(i < 10 ? 0.0 : 1.0), 0.0) << bad;
    hot.armed().ask_for(2, 1.0);  // the first force is too much for it
    EXPECT_EQ(hot.gate.fault(), GateFault::overheated) << bad;
    ForceGate straight({5.0, 5.0, bad});
    for (int i = 0; i < 700; ++i)
      ASSERT_EQ(straight.pass({{}, x(i < 10 ? 0.0 : 0.1), {}, 0.0, 1e-3}).torque[0], 0.0) << bad;
  }
}

// The largest numbers have a norm that is none, and a direction all the same.
TEST(ForceGate, keeps_the_direction_of_a_force_whose_norm_is_no_number) {
  constexpr double most = std::numeric_limits<double>::max();
  Driven d({2.0, 2.0, 0.0});
  d.armed();
  Triple last{};
  for (int i = 0; i < 10; ++i) last = d.ask({most, -most, 0.0});
  EXPECT_NEAR(last[0], std::sqrt(2.0), 1e-12);
  EXPECT_NEAR(last[1], -std::sqrt(2.0), 1e-12);
}

TEST(ForceGate, treats_all_three_directions_alike) {
  Driven d;
  d.armed();
  for (int i = 0; i < 20; ++i) d.ask({1.0, 2.0, -2.0});
  const Triple held = d.ask({1.0, 2.0, -2.0}, 0.03, {0.1, -0.2, 0.3});
  const Triple expected{0.9, 2.2, -2.3};
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(held[k], expected[k], 1e-12) << k;
  const Triple falling = d.ask({0.0, 0.0, 0.0});  // by 1 N of its 3.3 N
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(falling[k], expected[k] * (1.0 - 1.0 / norm(expected)), 1e-12) << k;
}

TEST(ForceGate, gives_as_little_as_a_small_limit_allows) {
  Driven d({5e-4, 1.0, 0.5});
  d.armed();
  EXPECT_DOUBLE_EQ(d.ask_for(10, 1.0), 5e-4);
}

// --- torque

TEST(ForceGate, treats_torques_like_forces_in_proportion_to_their_peak) {
  ForceGate gate({5.0, 5.0, 0.5});  // a newton is 0.1 N m
  const auto ask = [&](double torque) { return gate.pass({{}, x(torque), {}, 0.0, 1e-3}).torque[0]; };
  for (int i = 0; i < 50; ++i) EXPECT_EQ(ask(0.021), 0.0);  // not quiet
  for (int i = 0; i < 600; ++i) ask(0.0);
  for (double expected : {0.05, 0.1, 0.15}) EXPECT_NEAR(ask(3.0), expected, 1e-15);
  for (int i = 0; i < 20; ++i) ask(3.0);
  EXPECT_DOUBLE_EQ(ask(3.0), 0.5);
  EXPECT_NEAR(ask(0.0), 0.4, 1e-15);
}

TEST(ForceGate, gives_no_torque_to_a_device_that_shows_none) {
  ForceGate gate({5.0, 5.0, 0.0});
  for (int i = 0; i < 1000; ++i)
    ASSERT_EQ(gate.pass({{}, x(i < 10 ? 0.0 : 0.1), {}, 0.0, 1e-3}).torque[0], 0.0);
  EXPECT_EQ(gate.state(), GateState::armed);
  ForceGate no_force({0.0, 5.0, 0.5});
  for (int i = 0; i < 1000; ++i)
    ASSERT_EQ(no_force.pass({{}, x(i < 10 ? 0.0 : 0.1), {}, 0.0, 1e-3}).torque[0], 0.0);
}

TEST(ForceGate, gives_torque_to_a_device_of_hardly_any_force) {
  ForceGate gate({5e-4, 5.0, 0.5});
  double torque = 0.0;
  for (int i = 0; i < 1200; ++i) torque = gate.pass({{}, x(i < 600 ? 0.0 : 0.3), {}, 0.0, 1e-3}).torque[0];
  EXPECT_DOUBLE_EQ(torque, 0.3);
}

// --- ceiling

TEST(ForceGate, lets_no_more_through_than_the_tick_allows) {
  Driven d;
  d.at(2.0);
  EXPECT_DOUBLE_EQ(d.gate.pass({x(2.0), {}, {}, 0.0, 1e-3, 1.5}).force[0], 1.5);
  EXPECT_DOUBLE_EQ(d.gate.pass({x(2.0), {}, {}, 0.0, 1e-3, infinity}).force[0], 2.0);
  EXPECT_DOUBLE_EQ(d.gate.pass({x(2.0), {}, {}, 0.0, 1e-3, 1.9995}).force[0], 1.9995);  // hardly
  EXPECT_EQ(d.gate.interventions().ceiling, 1);
  EXPECT_DOUBLE_EQ(d.gate.pass({x(2.0), {}, {}, 0.0, 1e-3, 1.998}).force[0], 1.998);
  EXPECT_EQ(d.gate.interventions().ceiling, 2);
  EXPECT_DOUBLE_EQ(d.ask(2.0), 2.0);
  EXPECT_EQ(d.gate.interventions().peak, 0);
  EXPECT_DOUBLE_EQ(d.gate.pass({x(2.0), {}, {}, 0.0, 1e-3, -1.0}).force[0],
                   1.0);  // by the slew towards nothing
  EXPECT_DOUBLE_EQ(d.gate.pass({x(2.0), {}, {}, 0.0, 1e-3, -1.0}).force[0], 0.0);
  EXPECT_EQ(d.gate.fault(), GateFault::none);
}

TEST(ForceGate, lowers_a_held_force_too) {
  Driven d;
  d.at(2.0);
  EXPECT_DOUBLE_EQ(d.gate.pass({x(2.0), {}, {}, 30e-3, 1e-3, 1.25}).force[0], 1.25);
  EXPECT_DOUBLE_EQ(d.gate.pass({x(2.0), {}, {}, 31e-3, 1e-3, 10.0}).force[0],
                   1.75);  // and comes back by the slew
}

}  // namespace
}  // namespace acus::haptics
