// What turns the force off, and how: the faults of the force gate. The figures are those of the design: each
// test goes red when its guard is taken out.
#include <random>

#include "driven_gate.h"
#include "many_ticks.h"

namespace acus::haptics {
namespace {

TEST(ForceGate, turns_off_for_a_number_that_is_none_wherever_it_stands) {
  for (double bad : {nan, infinity, -infinity})
    for (int where = 0; where < 12; ++where) {
      Driven d;
      d.at(2.5);
      GateCommand command{x(2.5), {}, {}, 0.0, 1e-3};
      (where < 3    ? command.force[where]
       : where < 6  ? command.torque[where - 3]
       : where < 9  ? command.velocity[where - 6]
       : where < 10 ? command.age
       : where < 11 ? command.elapsed
                    : command.ceiling) = where < 11 ? bad : nan;  // without end is a ceiling, too
      EXPECT_DOUBLE_EQ(d.gate.pass(command).force[0], 1.5) << where;
      EXPECT_EQ(d.gate.fault(), GateFault::not_finite);
      EXPECT_DOUBLE_EQ(d.ask(2.5), 0.5);  // latched, although all is well again
      EXPECT_DOUBLE_EQ(d.ask(2.5), 0.0);
      for (int i = 0; i < 1000; ++i) ASSERT_EQ(d.ask(0.1), 0.0);
      EXPECT_EQ(d.gate.interventions().faults[1], 1);
    }
}

TEST(ForceGate, latches_a_number_that_is_none_before_any_force_is_on) {
  Driven d;
  d.ask(nan);
  for (int i = 0; i < 1000; ++i) ASSERT_EQ(d.ask(0.1), 0.0);
  EXPECT_EQ(d.gate.fault(), GateFault::not_finite);
}

TEST(ForceGate, comes_back_after_a_fault_only_when_rearmed_and_as_at_the_start) {
  Driven d;
  d.at(1.0);
  d.ask(nan);
  d.gate.rearm();
  EXPECT_EQ(d.gate.fault(), GateFault::none);
  EXPECT_EQ(d.gate.state(), GateState::disarmed);
  for (int i = 0; i < 100; ++i) ASSERT_EQ(d.ask(1.0), 0.0);
  d.ask_for(3, 0.1);
  EXPECT_EQ(d.gate.state(), GateState::disarmed);
  d.ask(0.1);
  EXPECT_NEAR(d.ask(1.0), 1.0 / 500.0, 1e-12);
}

// A fault in the midst of the quiet ticks, in the midst of the ramp, and while it still fades.
TEST(ForceGate, begins_from_nothing_whenever_it_is_rearmed) {
  Driven counting, ramping, fading({8.5, 1.0, 0.0});
  counting.ask_for(3, 0.0);
  counting.ask(nan);
  counting.gate.rearm();
  counting.ask_for(3, 0.0);
  EXPECT_EQ(counting.gate.state(), GateState::disarmed);  // the quiet ticks of before do not count
  ramping.ask_for(250, 0.0);
  ramping.ask(0.1, 0.06);
  EXPECT_EQ(ramping.gate.state(), GateState::disarmed);
  EXPECT_EQ(ramping.gate.fault(), GateFault::stale);
  ramping.gate.rearm();
  ramping.ask_for(4, 0.0);
  EXPECT_NEAR(ramping.ask(0.1), 0.1 / 500.0, 1e-12);
  fading.armed();
  fading.ask_until_fault(1.5);
  fading.ask_for(100, 1.5);
  fading.gate.rearm();
  for (double expected : {0.3485, 0.0}) EXPECT_NEAR(fading.ask(1.5), expected, 1e-9);  // falls by 1 N
}

// Held commands are no command to count on: quiet ticks must follow one another.
TEST(ForceGate, counts_its_quiet_ticks_anew_after_an_old_command) {
  Driven d;
  d.ask_for(3, 0.0);
  d.ask(0.0, 0.03);
  d.ask_for(3, 0.0);
  EXPECT_EQ(d.gate.state(), GateState::disarmed);
}

TEST(ForceGate, counts_the_ticks_of_its_ramp_as_held_back) {
  Driven d;
  d.armed();
  EXPECT_NEAR(d.gate.interventions().disarmed, 504, 1);
  d.ask_for(100, 1.0);
  EXPECT_NEAR(d.gate.interventions().disarmed, 504, 1);
}

TEST(ForceGate, rearming_without_a_fault_changes_nothing) {
  Driven d;
  d.at(1.0);
  d.gate.rearm();
  EXPECT_EQ(d.ask(1.0), 1.0);
}

TEST(ForceGate, follows_a_command_up_to_the_age_of_20_ms_and_holds_and_damps_an_older_one) {
  Driven d;
  d.at(1.0);
  EXPECT_DOUBLE_EQ(d.ask(1.1, 0.020), 1.1);
  EXPECT_DOUBLE_EQ(d.ask(1.5, 0.0201), 1.1);                   // held
  EXPECT_DOUBLE_EQ(d.ask(1.5, 0.050, 0.3), 1.1 - 0.3);         // 1 N s/m against the motion
  EXPECT_DOUBLE_EQ(d.ask(1.5, 0.050, -0.3), 1.1 + 0.3 - 0.1);  // rising by no more than 0.5 N
  EXPECT_EQ(d.gate.interventions().held, 3);
  EXPECT_EQ(d.gate.fault(), GateFault::none);
  EXPECT_DOUBLE_EQ(d.ask(1.2), 1.2);  // and goes on when the simulation does
}

TEST(ForceGate, is_at_zero_before_the_command_is_100_ms_old_and_stays_there) {
  for (double force : {0.3, 1.0, 3.3, 8.5}) {
    Driven d({8.5, 8.5, 0.0});
    d.at(force);
    double last = force;
    for (int ms = 1; ms < 100; ++ms) {
      const double now = d.ask(force, ms * 1e-3);
      if (ms <= 50) {
        ASSERT_EQ(now, force) << ms;
      }
      ASSERT_LE(now, last);
      ASSERT_GE(now, last - 0.25) << "a ramp, not a drop";
      last = now;
    }
    EXPECT_EQ(last, 0.0);
    EXPECT_EQ(d.gate.fault(), GateFault::stale);
    for (int i = 0; i < 1000; ++i) ASSERT_EQ(d.ask(0.1), 0.0);
  }
}

// A loop that is itself late must reach zero in time all the same.
TEST(ForceGate, ramps_down_by_the_clock_when_ticks_are_late) {
  Driven d;
  d.at(1.0);
  double last = 1.0;
  for (int ms = 55; ms < 105; ms += 5) last = d.gate.pass({x(1.0), {}, {}, ms * 1e-3, 5e-3}).force[0];
  EXPECT_EQ(last, 0.0);
}

TEST(ForceGate, turns_off_when_the_handle_is_faster_than_1200_mm_per_second) {
  Driven d;
  d.at(2.5);
  EXPECT_DOUBLE_EQ(d.ask(2.5, 0.0, 1.2), 2.5);
  EXPECT_DOUBLE_EQ(d.ask(2.5, 0.0, 1.2001), 1.5);
  EXPECT_EQ(d.gate.fault(), GateFault::over_speed);
  d.ask_for(2, 2.5);
  EXPECT_EQ(d.ask(2.5), 0.0);
}

// At four ticks a millisecond too: off is off, with no ramp but the slew.
TEST(ForceGate, turns_off_at_once_however_short_the_tick) {
  Driven fast, broken;
  fast.at(0.3);
  broken.at(0.3);
  EXPECT_NEAR(fast.gate.pass({x(0.3), {}, x(2.0), 0.0, 0.25e-3}).force[0], 0.05, 1e-12);
  broken.gate.pass({x(nan), {}, {}, 0.0, 0.25e-3});
  EXPECT_EQ(broken.gate.pass({x(0.3), {}, {}, 0.0, 0.25e-3}).force[0], 0.0);
}

TEST(ForceGate, believes_no_tick_of_more_than_a_tenth_of_a_second) {
  Driven d({8.5, 1.0, 0.0});
  d.at(1.0);
  for (int i = 0; i < 90; ++i) d.gate.pass({x(1.0), {}, {}, 0.0, 1e6});  // 9 N s, not a million
  EXPECT_EQ(d.gate.fault(), GateFault::none);
}

TEST(ForceGate, measures_speed_in_all_directions) {
  Driven d;
  d.at(1.0);
  d.ask(x(1.0), 0.0, {0.7, 0.7, 0.7});
  EXPECT_EQ(d.gate.fault(), GateFault::over_speed);
}

// 10 N s in 10 s may be spent; 1.5 N has spent them after 6.67 s.
TEST(ForceGate, ramps_down_over_a_second_when_the_mean_of_ten_seconds_is_too_high) {
  Driven d({8.5, 1.0, 0.0});
  d.armed();
  const int ticks = d.ask_until_fault(1.5);
  EXPECT_EQ(d.gate.fault(), GateFault::overheated);
  EXPECT_NEAR(ticks, 10.0 / 1.5 * 1000, 5);
  EXPECT_NEAR(d.ask_for(499, 1.5), 0.75, 1e-9);  // half of the second has gone
  EXPECT_NEAR(d.ask_for(499, 1.5), 1.5e-3, 1e-9);
  EXPECT_NEAR(d.ask(1.5), 0.0, 1e-12);
  for (int i = 0; i < 12000; ++i) ASSERT_LT(d.ask(0.1), 1e-12);  // latched, cool as it is now
}

TEST(ForceGate, stands_what_the_device_may_show_for_ever) {
  Driven steady({8.5, 1.0, 0.0}), pulsed({8.5, 1.0, 0.0});
  steady.armed();
  pulsed.armed();
  for (int i = 0; i < 60000; ++i) {
    ASSERT_NEAR(steady.ask(0.99), 0.99, 0.5) << i;
    pulsed.ask(i % 4000 < 1000 ? 3.0 : 0.0);
    ASSERT_EQ(pulsed.gate.fault(), GateFault::none) << i;
  }
  EXPECT_EQ(steady.gate.fault(), GateFault::none);
}

TEST(ForceGate, forgets_what_was_more_than_ten_seconds_ago) {
  Driven d({8.5, 1.0, 0.0});
  d.armed();
  d.ask_for(6000, 1.5);  // 9 N s
  d.ask_for(4000, 0.0);
  d.ask_for(500, 1.5);  // the first second of them has left the window meanwhile
  EXPECT_EQ(d.gate.fault(), GateFault::none);
  d.ask_for(9000, 0.0);
  d.ask_for(6000, 1.5);
  EXPECT_EQ(d.gate.fault(), GateFault::none);
}

// The windows are used again and again: what they held before must be gone.
TEST(ForceGate, still_counts_after_many_times_ten_seconds) {
  Driven d({8.5, 1.0, 0.0});
  d.armed();
  d.ask_for(45000, 0.9);
  const int ticks = d.ask_until_fault(1.9);
  EXPECT_NEAR(ticks, 1000, 110);  // each tick adds 1 mN s to the 9 N s that are there
}

TEST(ForceGate, stays_off_while_it_is_still_too_hot) {
  Driven d({8.5, 1.0, 0.0});
  d.armed();
  d.ask_until_fault(3.0);
  d.ask_for(1100, 0.0);
  d.gate.rearm();
  d.ask_for(1000, 0.0);
  EXPECT_EQ(d.gate.state(), GateState::disarmed);
  d.ask_for(9000, 0.0);
  EXPECT_EQ(d.gate.state(), GateState::armed);
}

TEST(ForceGate, follows_the_faster_of_two_faults_and_tells_the_first) {
  Driven d({8.5, 1.0, 0.0});
  d.armed();
  d.ask_until_fault(1.5);
  d.ask(1.5, 0.0, 1.3);
  EXPECT_EQ(d.gate.fault(), GateFault::overheated);
  d.ask(1.5);
  EXPECT_EQ(d.ask(1.5), 0.0);
  EXPECT_EQ(d.gate.fault(), GateFault::overheated);
  EXPECT_EQ(d.ask(1.5, 0.06), 0.0);  // a slower one does not bring it back
  EXPECT_EQ(d.ask(1.5), 0.0);
}

// --- whatever comes

TEST(ForceGate, a_million_ticks_of_anything_give_finite_bounded_slow_forces) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  std::normal_distribution<double> normal;
  const double oddities[] = {nan,   infinity, -infinity, 1e300, -1e300, std::numeric_limits<double>::max(),
                             5e-324};
  Driven d({3.3, 0.88, 0.1});
  GateOutput last;
  long on = 0;
  for (long i = 0; i < many_ticks; ++i) {
    GateCommand command{{normal(random), normal(random), normal(random)}, {}, {}, 0.0, 1e-3};
    command.torque = {0.1 * normal(random), 0.0, 0.0};
    command.elapsed = unit(random) < 0.1 ? 5e-3 * unit(random) : 1e-3;
    if (i % 2000 < 600) command.force = command.torque = {};
    if (unit(random) < 0.001) {
      double* fields[] = {&command.force[0], &command.torque[1], &command.velocity[2],
                          &command.age,      &command.elapsed,   &command.ceiling};
      *fields[i % 6] = oddities[static_cast<std::size_t>(unit(random) * 7.0)];
    }
    if (d.gate.fault() != GateFault::none && unit(random) < 0.01) d.gate.rearm();
    const GateOutput now = d.gate.pass(command);
    for (int k = 0; k < 3; ++k) ASSERT_TRUE(std::isfinite(now.force[k]) && std::isfinite(now.torque[k])) << i;
    ASSERT_LE(norm(now.force), 3.3 * (1.0 + 1e-15)) << i;
    ASSERT_LE(norm(now.torque), 0.1 * (1.0 + 1e-15)) << i;
    const double change =
        norm({now.force[0] - last.force[0], now.force[1] - last.force[1], now.force[2] - last.force[2]});
    ASSERT_LE(change, (norm(now.force) > norm(last.force) ? 0.5 : 1.0) + 1e-12) << i;
    on += norm(now.force) > 0.1;
    last = now;
  }
  EXPECT_GT(on, many_ticks / 20);  // it was not just off
}

}  // namespace
}  // namespace acus::haptics
