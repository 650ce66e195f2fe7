#include "acus/needle/rod.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <random>

#include "acus/needle/buckling.h"
#include "acus/needle/elastica.h"
#include "testing_machine.h"

namespace {

using namespace machine;
using std::numbers::pi;

NeedleSpec steel(Support support) { return table_one(support, 2e-4); }

Pose towards(const Vec3& direction) {
  Pose pose;
  pose.tangent = direction.normalized();
  pose.director = pose.tangent.unitOrthogonal();
  return pose;
}

// Presses the ends together along the axis.
struct Press {
  Press(Support support, const Vec3& direction, int edges = 40)
      : hub(towards(direction)), machine(steel(support), edges, hub) {
    const Vec3& a = hub.tangent;
    tip.pose = hub;
    tip.pose.position = hub.position + length * a;
    tip.stiffness =
        1e5 * (support == Support::clamped_free ? Mat3(a * a.transpose()) : Mat3(Mat3::Identity()));
  }
  // At 20 mm/s, and then to rest.
  void to(double shortening_ratio) {
    const double target = shortening_ratio * length;
    const double h = 1e-3, speed = 0.02;
    while (travel < target) {
      travel = std::min(target, travel + h * speed);
      hub.position = travel * hub.tangent;
      ASSERT_TRUE(machine.step(hub, tip, h)) << "at a travel of " << travel;
    }
    ASSERT_TRUE(machine.rest(hub, tip, h)) << "at a travel of " << travel;
  }
  // The bow it grew with has shown it the way; from here on it is Euler's rod: straight when unloaded, and
  // hardly stretching.
  void idealise() {
    for (auto& turning : machine.rod.natural_turning) turning = {0.0, 0.0};
    machine.rod.axial *= 10.0;
    ASSERT_TRUE(machine.rest(hub, tip, 0.01));
  }
  double tip_slope() const {
    return std::acos(edge(machine.state, machine.rod.edges - 1).normalized().dot(hub.tangent));
  }
  double lateral_ratio() const { return hub.tangent.cross(machine.tip_force(tip)).norm() / load(); }
  // The vice gives way a little, and so does the rod's length.
  double shortening_ratio() const {
    return 1.0 - (machine.state.position.back() - hub.position).dot(hub.tangent) / length;
  }
  double load() const { return -machine.tip_force(tip).dot(hub.tangent); }
  double bow() const {
    double largest = 0.0;
    for (const Vec3& x : machine.state.position) {
      const Vec3 r = x - hub.position;
      largest = std::max(largest, (r - r.dot(hub.tangent) * hub.tangent).norm());
    }
    return largest;
  }
  Pose hub;
  Machine machine;
  Tip tip;
  double length = 0.2, travel = 0.0;
};

class RodOnEachSupport : public testing::TestWithParam<Support> {};
INSTANTIATE_TEST_SUITE_P(Rod, RodOnEachSupport, testing::ValuesIn(all_supports));

TEST_P(RodOnEachSupport, pressed_together_is_the_elastica) {
  Press press(GetParam(), Vec3(2.0, -1.0, -2.0));
  press.to(0.01);
  press.idealise();
  const double critical = critical_load(bending_rigidity(steel(GetParam())), 0.2, GetParam());
  for (const double d : {0.01, 0.05, 0.1, 0.2, 0.3}) {
    press.to(d);
    const Elastica exact = elastica(GetParam(), press.shortening_ratio());
    EXPECT_NEAR(press.load() / critical / exact.load_ratio, 1.0, 0.01) << d;
    EXPECT_NEAR(press.bow() / 0.2 / exact.bow_ratio, 1.0, 0.01) << d;
    double arc = 0.0;
    for (int j = 0; j < press.machine.rod.edges; ++j) arc += edge(press.machine.state, j).norm();
    EXPECT_NEAR(arc / 0.2, 1.0, 1e-4);
  }
}

// Largest distance of a node from its place on the elastica, / length.
double distance_from(const Elastica& exact, const Press& press) {
  double largest = 0.0;
  for (int i = 0; i < press.machine.rod.nodes(); ++i) {
    const Vec3 r = (press.machine.state.position[i] - press.hub.position) / press.length;
    const double axial = r.dot(press.hub.tangent);
    const ElasticaPoint p = elastica_point(exact, static_cast<double>(i) / press.machine.rod.edges);
    largest =
        std::max(largest, std::hypot(axial - p.axial, (r - axial * press.hub.tangent).norm() - p.lateral));
  }
  return largest;
}

TEST_P(RodOnEachSupport, comes_to_the_elastica_with_the_square_of_its_elements) {
  const double critical = critical_load(bending_rigidity(steel(GetParam())), 0.2, GetParam());
  double last_load = 0.0, last_distance = 0.0;
  for (const int edges : {10, 20, 40, 80}) {
    Press press(GetParam(), Vec3(0.0, 0.0, -1.0), edges);
    press.to(0.2);
    press.idealise();
    const Elastica exact = elastica(GetParam(), press.shortening_ratio());
    const double load = press.load() / critical / exact.load_ratio - 1.0;
    const double distance = distance_from(exact, press);
    if (edges > 20) {
      EXPECT_NEAR(last_load / load, 4.0, 0.5) << edges;
      EXPECT_NEAR(last_distance / distance, 4.0, 0.5) << edges;
    }
    last_load = load;
    last_distance = distance;
  }
}

// Clamped-pinned, by shooting on the exact equation.
struct Shot {
  double shortening_ratio, load_ratio, bow_ratio, tip_slope, lateral_ratio;  // slope in degrees
};
constexpr std::array<Shot, 5> shots{{{0.01, 1.0038, 0.0620, 14.3, 0.045},
                                     {0.05, 1.0189, 0.1366, 32.3, 0.104},
                                     {0.1, 1.0380, 0.1895, 46.3, 0.153},
                                     {0.2, 1.0758, 0.2569, 67.2, 0.238},
                                     {0.3, 1.1103, 0.2997, 84.9, 0.326}}};

TEST(Rod, clamped_and_pinned_takes_the_slope_and_the_side_force_of_the_elastica) {
  Press press(Support::clamped_pinned, Vec3(1.0, 1.0, -3.0));
  press.to(0.01);
  press.idealise();
  const double critical =
      critical_load(bending_rigidity(steel(Support::clamped_pinned)), 0.2, Support::clamped_pinned);
  for (const Shot& shot : shots) {
    press.to(shot.shortening_ratio);
    EXPECT_NEAR(press.load() / critical / shot.load_ratio, 1.0, 0.005);
    EXPECT_NEAR(press.bow() / 0.2 / shot.bow_ratio, 1.0, 0.005);
    EXPECT_NEAR(press.tip_slope() * 180.0 / pi / shot.tip_slope, 1.0, 0.01);
    EXPECT_NEAR(press.lateral_ratio() / shot.lateral_ratio, 1.0, 0.015);
  }
}

TEST(Rod, buckles_alike_whichever_way_it_points) {
  std::mt19937_64 random(5);
  std::normal_distribution<double> any;
  const auto pressed = [](const Vec3& direction) {
    Press press(Support::clamped_pinned, direction);
    press.to(0.01);
    press.idealise();
    press.to(0.1);
    return press;
  };
  const Press upright = pressed(Vec3(0.0, 0.0, -1.0));
  for (int trial = 0; trial < 5; ++trial) {
    const Press press = pressed(Vec3(any(random), any(random), any(random)));
    EXPECT_NEAR(press.load() / upright.load(), 1.0, 1e-5);
    EXPECT_NEAR(press.bow() / upright.bow(), 1.0, 1e-5);
    EXPECT_NEAR(press.tip_slope() / upright.tip_slope(), 1.0, 1e-5);
  }
}

}  // namespace
