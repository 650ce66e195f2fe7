// The force that the energy balance gives, against forces that are known as functions of the travel.
#include "acus/force/energy_force.h"

#include <gtest/gtest.h>

#include <vector>

namespace acus::force {
namespace {

// A force F(x) = slope x + ripple sin(k x), and its work from 0 to x.
constexpr double slope = 50.0, ripple = 0.2, wave_number = 300.0;  // N/m, N, 1/m
double true_force(double x) { return slope * x + ripple * std::sin(wave_number * x); }
double true_work(double x) {
  return 0.5 * slope * x * x + ripple * (1.0 - std::cos(wave_number * x)) / wave_number;
}

TEST(EnergyForce, follows_the_force_a_travel_behind) {
  for (double stride : {0.2e-6, 1e-6, 10e-6, 73e-6, 300e-6}) {
    EnergyForce energy;
    const double lag = stride + energy_force_travel;
    const double steepest = slope + ripple * wave_number;
    for (int i = 0; i * stride < 5e-3; ++i) {
      const double x = i * stride;
      const double force = energy.after(x, true_work(x));
      // The mean over a stretch that is at most `lag` long and ended at most `lag` ago.
      if (x > 2.0 * lag) {
        ASSERT_NEAR(force, true_force(x - lag), steepest * lag) << x;
      }
    }
  }
}

TEST(EnergyForce, is_exact_for_a_constant_force) {
  EnergyForce energy;
  for (int i = 0; i < 1000; ++i) {
    const double force = energy.after(i * 10e-6, 0.7 * i * 10e-6);
    if (i >= 11) {
      EXPECT_NEAR(force, 0.7, 1e-12);
    }
  }
}

TEST(EnergyForce, is_signed_alike_going_in_and_coming_out) {
  EnergyForce energy;  // a spring: it pushes out both ways
  double force = 0.0;
  for (int i = 0; i <= 1000; ++i) force = energy.after(i * 10e-6, 0.5 * slope * i * i * 1e-10);
  EXPECT_NEAR(force, slope * 10e-3, slope * 0.1e-3);
  for (int i = 1000; i >= 500; --i) force = energy.after(i * 10e-6, 0.5 * slope * i * i * 1e-10);
  EXPECT_NEAR(force, slope * 5e-3, slope * 0.1e-3);
}

TEST(EnergyForce, pulls_back_on_a_hand_that_drags_out_against_friction) {
  EnergyForce energy;
  double work = 0.0, force = 0.0;
  for (int i = 1; i <= 500; ++i) force = energy.after(i * 10e-6, work += 0.4 * 10e-6);
  EXPECT_NEAR(force, 0.4, 1e-9);
  for (int i = 500; i >= 1; --i) force = energy.after(i * 10e-6, work += 0.4 * 10e-6);
  EXPECT_NEAR(force, -0.4, 1e-9);
}

TEST(EnergyForce, keeps_its_value_at_rest_and_until_a_turn_has_gone_far_enough) {
  EnergyForce energy;
  const double stride = 0.7e-6, inward = 0.9, outward = 0.1;  // m, N, N: friction both ways
  double force = 0.0, travel = 0.0, work = 0.0;
  for (int i = 0; i < 301; ++i) force = energy.after(travel += stride, work += inward * stride);
  EXPECT_NEAR(force, inward, 1e-9);
  for (int i = 0; i < 5000; ++i) EXPECT_EQ(energy.after(travel, work), force);
  double back = 0.0;
  for (; back < energy_force_travel - stride; back += stride)
    EXPECT_EQ(energy.after(travel -= stride, work += outward * stride), force) << back;
  for (int i = 0; i < 50; ++i)  // nothing of the way in counts on the way out
    EXPECT_NEAR(energy.after(travel -= stride, work += outward * stride), -outward, 1e-9) << i;
}

TEST(EnergyForce, survives_a_hand_that_trembles) {
  EnergyForce energy;
  double force = 1.0;
  for (int i = 0; i < 100'000; ++i) {
    const double x = i % 2 ? 0.4 * energy_force_travel : 0.0;
    force = energy.after(x, true_work(x));
    ASSERT_TRUE(std::isfinite(force));
  }
  EXPECT_EQ(force, 0.0);  // it has never gone far enough one way to tell
}

}  // namespace
}  // namespace acus::force
