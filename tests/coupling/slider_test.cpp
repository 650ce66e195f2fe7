// The spring in series with a slider: hand-worked cases, and what holds on any path.
#include "acus/coupling/slider.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <cmath>

namespace acus::coupling {
namespace {

// k = 100 N/m, bounds -2 N and 3 N.
constexpr Slider friction = {100.0, 0.0, -2.0, 3.0, false};

TEST(Slider, sticks_below_its_bounds) {
  const SliderStep step = advance(friction, 0.02);
  EXPECT_DOUBLE_EQ(step.force, 2.0);
  EXPECT_DOUBLE_EQ(step.elongation, 0.02);
  EXPECT_EQ(step.slip, 0.0);
  EXPECT_EQ(step.dissipated, 0.0);
  EXPECT_DOUBLE_EQ(step.numerical, 0.02);  // 2 N over 0.02 m, half of it stored
}

TEST(Slider, slips_forward_at_its_upper_bound) {
  const SliderStep step = advance(friction, 0.05);  // trial 5 N: 0.03 m of spring, 0.02 m of slip
  EXPECT_DOUBLE_EQ(step.force, 3.0);
  EXPECT_DOUBLE_EQ(step.elongation, 0.03);
  EXPECT_NEAR(step.slip, 0.02, 1e-15);
  EXPECT_NEAR(step.dissipated, 0.06, 1e-15);
  EXPECT_NEAR(step.numerical, 0.045, 1e-15);  // 0.15 J of work, 0.045 stored, 0.06 dissipated
}

TEST(Slider, slips_back_at_its_lower_bound) {
  Slider slider = friction;
  slider.elongation = 0.01;
  const SliderStep step = advance(slider, -0.04);  // trial -3 N
  EXPECT_DOUBLE_EQ(step.force, -2.0);
  EXPECT_DOUBLE_EQ(step.elongation, -0.02);
  EXPECT_NEAR(step.slip, -0.01, 1e-15);
  EXPECT_NEAR(step.dissipated, 0.02, 1e-15);
}

TEST(Slider, holds_the_force_of_a_pause) {
  const SliderStep moving = advance(friction, 0.05);
  Slider paused = friction;
  paused.elongation = moving.elongation;
  const SliderStep step = advance(paused, 0.0);
  EXPECT_DOUBLE_EQ(step.force, 3.0);
  EXPECT_EQ(step.slip, 0.0);
  EXPECT_EQ(step.numerical, 0.0);
}

// k = 1000 N/m, at most 1 N: a tip that ruptures.
constexpr Slider contact = {1000.0, 0.0, 0.0, 1.0, true};

TEST(Slider, contact_opens_without_force_and_keeps_the_gap) {
  Slider slider = contact;
  slider.elongation = 0.5e-3;
  const SliderStep away = advance(slider, -2e-3);
  EXPECT_EQ(away.force, 0.0);
  EXPECT_DOUBLE_EQ(away.elongation, -1.5e-3);
  EXPECT_EQ(away.slip, 0.0);
  EXPECT_DOUBLE_EQ(away.numerical, 0.5 * 1000.0 * 0.5e-3 * 0.5e-3);  // the spring let go in one step
  slider.elongation = away.elongation;
  const SliderStep back = advance(slider, 1.8e-3);  // 0.3 mm past touch
  EXPECT_NEAR(back.force, 0.3, 1e-12);
}

// At a puncture the bound falls from 1 N to 0.3: what the spring held too much is no fault of the integrator.
TEST(Slider, lets_go_what_a_fallen_bound_cannot_hold) {
  Slider slider = contact;
  slider.elongation = 1e-3;
  slider.upper = 0.3;
  const SliderStep step = advance(slider, 0.0);
  EXPECT_NEAR(step.slip, 0.7e-3, 1e-15);
  EXPECT_NEAR(step.dissipated, 0.3 * 0.7e-3, 1e-15);
  EXPECT_NEAR(step.released, 0.5 * 1000.0 * 0.7e-3 * 0.7e-3, 1e-15);
  EXPECT_EQ(step.numerical, 0.0);
}

TEST(Slider, contact_gives_way_at_its_rupture_force) {
  EXPECT_EQ(grip_after(contact, 0.9e-3), Grip::stick);
  EXPECT_EQ(grip_after(contact, 1.1e-3), Grip::slip_forward);
  EXPECT_EQ(grip_after(contact, -1e-6), Grip::open);
}

Slider any_slider() {
  const auto number = [](int low, int high) { return *rc::gen::inRange(low, high) * 1e-3; };
  Slider slider;
  slider.stiffness = number(1, 2'000'000);
  slider.unilateral = *rc::gen::arbitrary<bool>();
  slider.lower = slider.unilateral ? 0.0 : -number(0, 5000);
  slider.upper = number(0, 5000);
  return slider;
}

RC_GTEST_PROP(SliderProperty, never_gives_energy_back_and_stays_in_bounds, ()) {
  Slider slider = any_slider();
  const auto path = *rc::gen::container<std::vector<int>>(50, rc::gen::inRange(-3000, 3000));
  double work = 0.0, spent = 0.0, size = 0.0;
  for (int micrometres : path) {
    const double s = micrometres * 1e-6;
    const SliderStep step = advance(slider, s);
    const double rounding = 1e-12 * (std::abs(step.force * s) + stored_energy(slider, slider.elongation));
    RC_ASSERT(step.force <= slider.upper * (1.0 + 1e-14));
    RC_ASSERT(step.force >= slider.lower * (1.0 + 1e-14));
    RC_ASSERT(step.dissipated >= -rounding);
    RC_ASSERT(step.numerical >= -rounding);
    // The energy line at the head of slider.h, where the contact stays closed.
    if (step.elongation >= 0.0 && slider.elongation >= 0.0) {
      const double change = step.elongation - slider.elongation;
      RC_ASSERT(std::abs(step.numerical - 0.5 * slider.stiffness * change * change) <= rounding);
    }
    work += step.force * s;
    spent += step.dissipated + step.numerical;
    size += std::abs(step.force * s);
    slider.elongation = step.elongation;
  }
  RC_ASSERT(std::abs(work - spent - stored_energy(slider, slider.elongation)) <= 1e-11 * size);
}

RC_GTEST_PROP(SliderProperty, force_on_its_branch_is_the_force_of_the_step, ()) {
  Slider slider = any_slider();
  slider.elongation = *rc::gen::inRange(-3000, 3000) * 1e-6;
  const double s = *rc::gen::inRange(-3000, 3000) * 1e-6;
  const LinearForce force = force_on(slider, grip_after(slider, s));
  RC_ASSERT(force.constant + force.rate * s == advance(slider, s).force);
}

// Fine steps: what the step loses falls with the step, what slips does not.
TEST(Slider, loses_less_to_the_integrator_in_smaller_steps) {
  double before = 0.0;
  for (int steps : {10, 100, 1000}) {
    Slider slider = friction;
    double numerical = 0.0, dissipated = 0.0;
    for (int i = 0; i < steps; ++i) {
      const SliderStep step = advance(slider, 0.1 / steps);
      numerical += step.numerical;
      dissipated += step.dissipated;
      slider.elongation = step.elongation;
    }
    EXPECT_NEAR(dissipated, 3.0 * 0.07, 1e-12);
    if (before > 0.0) {
      EXPECT_NEAR(before / numerical, 10.0, 1e-6);
    }
    before = numerical;
  }
}

}  // namespace
}  // namespace acus::coupling
