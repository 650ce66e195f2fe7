// The simulated handle against closed forms of mechanics.
#include "acus/haptics/handle.h"

#include <gtest/gtest.h>

#include <cmath>

namespace acus::haptics {
namespace {

DeviceLimits body(double mass, double viscous, double coulomb = 0.0) {
  DeviceLimits limits;
  limits.mass = mass;
  limits.viscous = viscous;
  limits.coulomb = coulomb;
  return limits;
}

TEST(Handle, held_by_a_spring_swings_as_a_damped_oscillator) {
  const HandModel hand{0.1, 0.2, 50.0};
  const DeviceLimits limits = body(0.05, 0.1);
  Handle handle(limits, hand, {0.01, 0.0, 0.0});
  const double decay = 0.3 / (2.0 * 0.15), omega = std::sqrt(50.0 / 0.15 - decay * decay);
  for (double t : {0.05, 0.2, 0.5, 1.0}) {
    handle.advance_to(t, {});
    const double exact =
        0.01 * std::exp(-decay * t) * (std::cos(omega * t) + decay / omega * std::sin(omega * t));
    EXPECT_NEAR(handle.position().x(), exact, 1e-6 * 0.01 + 1e-8) << t;
  }
}

TEST(Handle, pushed_by_a_constant_force_reaches_the_speed_that_friction_allows) {
  Handle handle(body(0.045, 0.1, 0.26), no_hand);
  handle.command({0.36, 0.0, 0.0});
  handle.advance_to(10.0, {});
  EXPECT_NEAR(handle.velocity().x(), (0.36 - 0.26) / 0.1, 1e-3);
  Handle stuck(body(0.045, 0.1, 0.26), no_hand);
  stuck.command({0.25, 0.0, 0.0});
  stuck.advance_to(1.0, {});
  EXPECT_NEAR(stuck.position().norm(), 0.0, 1e-6);
}

TEST(Handle, feels_a_command_after_the_delay) {
  DeviceLimits limits = body(1.0, 0.0);
  limits.delay = 5e-3;
  Handle handle(limits, no_hand);
  handle.command({1.0, 0.0, 0.0});
  handle.advance_to(5e-3, {});
  EXPECT_EQ(handle.position().x(), 0.0);
  handle.advance_to(15e-3, {});
  EXPECT_NEAR(handle.position().x(), 0.5 * 0.01 * 0.01, 1e-12);
}

TEST(Handle, reads_its_place_in_whole_quanta) {
  DeviceLimits limits = body(1.0, 0.0);
  limits.quantum = 0.05e-3;
  EXPECT_DOUBLE_EQ(Handle(limits, no_hand, {0.12e-3, -0.13e-3, 0.0}).encoder().x(), 0.1e-3);
  EXPECT_DOUBLE_EQ(Handle(limits, no_hand, {0.12e-3, -0.13e-3, 0.0}).encoder().y(), -0.15e-3);
}

// A hand that drags a device with friction alone has put in what friction took and what still moves.
TEST(Handle, books_what_the_hand_puts_in) {
  const DeviceLimits limits = body(0.05, 0.1);
  Handle handle(limits, light_grip);
  double friction = 0.0, dt = 1e-4;
  for (int i = 1; i <= 10000; ++i) {
    const double t = i * dt;
    handle.advance_to(t, {Vec3(0.05 * t, 0.0, 0.0), Vec3(0.05, 0.0, 0.0)});
    friction += dt * 0.1 * handle.velocity().squaredNorm();
  }
  EXPECT_NEAR(handle.port_energy(), friction + 0.5 * 0.05 * handle.velocity().squaredNorm(),
              0.01 * handle.port_energy());
}

}  // namespace
}  // namespace acus::haptics
