// A rod in time, by implicit steps.
#include "acus/needle/rod_motion.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "testing_machine.h"

namespace {

using namespace machine;

NeedleSpec needle(Support support, double imperfection = 0.0) {
  NeedleSpec spec;  // Table I
  spec.support = support;
  spec.imperfection = imperfection;
  return spec;
}

double kinetic(const Machine& m) { return 0.5 * inertia_product(m.rod, m.state.rate); }

TEST(RodMotion, flies_on_with_a_hub_that_is_led_without_turning) {
  Pose hub;
  Machine m(needle(Support::clamped_free), 40, hub);
  const Vec3 speed(0.3, -0.2, 0.5);
  for (int i = 0; i < m.rod.unknowns(); ++i)
    if (!is_spin(i)) m.state.rate[i] = speed[i % 4];
  for (int step = 0; step < 100; ++step) {
    hub.position += 1e-3 * speed;
    ASSERT_TRUE(m.step(hub, Tip{}, 1e-3));
  }
  EXPECT_NEAR(kinetic(m) / (0.5 * mass(needle(Support::clamped_free)) * speed.squaredNorm()), 1.0, 1e-9);
  EXPECT_LT(total(m.energy()), 1e-12);
  EXPECT_LT(m.hub_force().norm(), 1e-6);
}

// A hub that turns about an axis across the needle, once to the full speed and then on: the needle follows
// like a stiff rod, but for what its root bends when it is taken along.
TEST(RodMotion, turns_with_its_hub) {
  constexpr double h = 1e-3, speed = 2.0;  // s, rad/s
  Pose hub;
  Machine m(needle(Support::clamped_free), 40, hub);
  double angle = 0.0;
  for (int step = 1; step <= 4000; ++step) {
    angle += h * speed * std::min(1.0, step / 1000.0);
    const auto turned = Eigen::AngleAxisd(angle, Vec3(1.0, 1.0, 0.0).normalized());
    hub.tangent = turned * Vec3(0.0, 0.0, -1.0);
    hub.director = turned * Vec3(1.0, 0.0, 0.0);
    ASSERT_TRUE(m.step(hub, Tip{}, h));
  }
  const NeedleSpec spec = needle(Support::clamped_free);
  const double exact = mass(spec) * spec.length * spec.length * speed * speed / 6.0;
  EXPECT_NEAR(kinetic(m) / exact, 1.0, 0.01);
  EXPECT_LT(total(m.energy()), 0.01 * exact);
}

// About its own axis it turns as one body, twisted by nothing in the end.
TEST(RodMotion, spins_with_its_hub) {
  constexpr double h = 1e-3, speed = 20.0;  // s, rad/s
  Pose hub;
  Machine m(needle(Support::clamped_free), 40, hub);
  for (int step = 1; step <= 1000; ++step) {
    hub.director = Eigen::AngleAxisd(h * step * speed, hub.tangent) * Vec3(1.0, 0.0, 0.0);
    ASSERT_TRUE(m.step(hub, Tip{}, h));
  }
  const NeedleSpec spec = needle(Support::clamped_free);
  EXPECT_NEAR(kinetic(m) / (0.25 * mass(spec) * spec.radius * spec.radius * speed * speed), 1.0, 1e-3);
  EXPECT_LT(total(m.energy()), 1e-3 * kinetic(m));
  EXPECT_NEAR(m.state.director.back().dot(hub.director), 1.0, 1e-6);
}

// Bends and twists a rod at random, without stretching it.
void bend(Machine& m, std::mt19937_64& random) {
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  RodState& s = m.state;
  Vec3 last = edge(s, 0).normalized();
  Vec3 director = s.director[0];
  const double phase = 3.0 * any(random), twist = 0.2 * any(random);  // rad, per edge
  const Vec3 way(any(random), any(random), 0.0), other(any(random), any(random), 0.0);
  for (int j = 0; j < m.rod.edges; ++j) {
    const double here = static_cast<double>(j) / m.rod.edges;
    const Vec3 tangent = (Vec3(0.0, 0.0, -1.0) + here * std::sin(5.0 * here + phase) * way +
                          here * std::cos(9.0 * here) * other)
                             .normalized();
    director = Eigen::AngleAxisd(twist * here, tangent) * transported(director, last, tangent);
    s.position[j + 1] = s.position[j] + m.rod.edge_length[j] * tangent;
    s.director[j] = director;
    last = tangent;
  }
}

// Let go, it springs back and swings; implicit Euler only ever takes energy away.
TEST(RodMotion, never_gains_energy_by_itself) {
  std::mt19937_64 random(17);
  for (const Support support : all_supports)
    for (const double h : {1e-5, 1e-4, 1e-3}) {
      const Pose hub;
      Machine m(needle(support, 1e-3), 40, hub);
      bend(m, random);
      Tip tip;
      tip.pose = hub;
      tip.pose.position = m.state.position.back();
      if (support != Support::clamped_free) tip.stiffness = 3e3 * Mat3::Identity();
      const auto energy = [&] {
        return kinetic(m) + total(m.energy()) +
               0.5 * (tip.pose.position - m.state.position.back()).dot(m.tip_force(tip));
      };
      std::vector<double> force(m.rod.unknowns());
      double last = total(rod_forces_into(force, m.rod, m.state, hub, tip.pose));
      EXPECT_GT(last, 1e-3);  // J
      for (int step = 0; step < 200; ++step) {
        ASSERT_TRUE(m.step(hub, tip, h)) << h << ' ' << step;
        EXPECT_LT(energy(), last * (1.0 + 1e-12)) << h << ' ' << step;
        last = energy();
      }
    }
}

TEST(RodMotion, stays_finite_when_the_hub_leaps) {
  std::mt19937_64 random(23);
  std::normal_distribution<double> any;
  for (const Support support : all_supports) {
    Pose hub;
    Machine m(needle(support, 1e-4), 40, hub);
    Tip tip;
    tip.pose = hub;
    tip.pose.position = m.state.position.back();
    if (support != Support::clamped_free) tip.stiffness = 1e3 * Mat3::Identity();
    for (int step = 0; step < 200; ++step) {
      if (step % 10 == 0) {
        hub.position = 0.05 * Vec3(any(random), any(random), any(random));
        hub.tangent = (Vec3(0.0, 0.0, -1.0) + 0.5 * Vec3(any(random), any(random), any(random))).normalized();
        hub.director = hub.tangent.unitOrthogonal();
      }
      m.step(hub, tip, 1e-3);  // Newton's iteration may give up
      for (const double rate : m.state.rate) ASSERT_TRUE(std::isfinite(rate)) << step;
      for (const Vec3& x : m.state.position) ASSERT_TRUE(x.allFinite()) << step;
      for (const Vec3& d : m.state.director) ASSERT_NEAR(d.norm(), 1.0, 1e-9) << step;
    }
  }
}

}  // namespace
