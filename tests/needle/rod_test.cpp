#include "acus/needle/rod.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "acus/needle/buckling.h"
#include "acus/needle/elastica.h"
#include "testing_machine.h"

namespace {

using namespace machine;
using std::numbers::pi;

NeedleSpec steel(Support support, double imperfection = 2e-6) {
  NeedleSpec spec;  // Table I
  spec.support = support;
  spec.imperfection = imperfection;
  return spec;
}

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
    tip.pose.position = machine.state.position.back();
    tip.stiffness =
        3e4 * (support == Support::clamped_free ? Mat3(a * a.transpose()) : Mat3(Mat3::Identity()));
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

}  // namespace
