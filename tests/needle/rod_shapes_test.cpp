// Shapes that a loaded rod takes, against closed forms.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "acus/numeric/elliptic.h"
#include "testing_machine.h"

namespace {

using namespace machine;
using std::numbers::pi;

NeedleSpec straight(Support support) { return table_one(support, 0.0); }
const double length = NeedleSpec{}.length;

Pose askew() {
  Pose pose;
  pose.tangent = Vec3(2.0, -1.0, 2.0) / 3.0;
  pose.director = Vec3(1.0, 2.0, 0.0).normalized();
  return pose;
}

struct Deflected {
  double load;           // P L^2 / EI, across the unloaded rod
  double across, along;  // of the tip, / L; towards the load and towards the clamp
  double slope;          // of the tip, rad
};

// The elastica through elliptic integrals, from the slope of its tip (Bisshopp and Drucker, Quarterly of
// Applied Mathematics 3, 1945).
Deflected cantilever_by_slope(double slope) {
  const double k = std::sqrt(0.5 * (1.0 + std::sin(slope)));
  const auto whole = numeric::complete_elliptic(k);
  const auto part = numeric::incomplete_elliptic(std::asin(std::sqrt(0.5) / k), k);
  const double root = whole.first - part.first;
  return {root * root, 1.0 - 2.0 * (whole.second - part.second) / root,
          1.0 - std::sqrt(2.0 * std::sin(slope)) / root, slope};
}

// Mattiasson, International Journal for Numerical Methods in Engineering 17, 1981, Table 1.
constexpr std::array<Deflected, 4> mattiasson{{{1.0, 0.30172, 0.05643, 0.46135},
                                               {2.0, 0.49346, 0.16064, 0.78175},
                                               {5.0, 0.71379, 0.38763, 1.21537},
                                               {10.0, 0.81061, 0.55500, 1.43029}}};

TEST(RodShapes, published_cantilevers_agree_with_elliptic_integrals) {
  for (const Deflected& published : mattiasson) {
    const Deflected exact = cantilever_by_slope(published.slope);
    // The slope is given to five places; the load goes faster than it.
    EXPECT_NEAR(exact.load / published.load, 1.0, 1e-4);
    EXPECT_NEAR(exact.across, published.across, 2e-5);
    EXPECT_NEAR(exact.along, published.along, 2e-5);
  }
}

TEST(RodShapes, a_load_across_the_tip_bends_it_as_published) {
  const Pose hub = askew();
  const Vec3 across = hub.tangent.cross(hub.director);
  Machine m(straight(Support::clamped_free), 40, hub);
  for (const Deflected& published : mattiasson) {
    Tip tip;
    tip.force = published.load * m.rod.bending / (length * length) * across;
    ASSERT_TRUE(m.rest(hub, tip, 0.1)) << published.load;
    const Vec3 end = (m.state.position.back() - hub.position) / length;
    const Vec3 last = edge(m.state, m.rod.edges - 1).normalized();
    EXPECT_NEAR(end.dot(across), published.across, 5e-4);
    EXPECT_NEAR(1.0 - end.dot(hub.tangent), published.along, 5e-4);
    EXPECT_NEAR(std::acos(last.dot(hub.tangent)), published.slope, 5e-4);
    EXPECT_LT(std::abs(end.dot(hub.director)), 1e-9);
    EXPECT_LT((m.hub_force() + tip.force).norm(), 1e-4 * tip.force.norm());
  }
}

// A rod between two clamps, which are led to where they belong: what they do there is a couple alone, but
// free ends would let the rod escape sideways.
struct Clamped {
  Pose hub = askew();
  Tip tip;
  Machine machine;
  explicit Clamped(int edges) : machine(straight(Support::clamped_clamped), edges, hub) {
    tip.stiffness = 1e4 * Mat3::Identity();
  }

  // `tip_at(share)`: the tip's pose on the way from the unloaded rod (0) to the shape wanted (1).
  template <class TipAt>
  void to(TipAt tip_at) {
    constexpr int parts = 20;
    for (int part = 1; part <= parts; ++part) {
      tip.pose = tip_at(static_cast<double>(part) / parts);
      ASSERT_TRUE(machine.rest(hub, tip, 0.1)) << "part " << part;
    }
  }
  Vec3 place(int node) const { return machine.state.position[node] - hub.position; }
};

Vec3 turned(const Vec3& v, double angle, const Vec3& axis) { return Eigen::AngleAxisd(angle, axis) * v; }

TEST(RodShapes, bends_to_a_full_circle_under_an_end_moment) {
  Clamped rod(40);
  const Pose& hub = rod.hub;
  const Vec3& axis = hub.director;
  const Vec3 to_centre = axis.cross(hub.tangent);
  rod.to([&](double share) {
    const double angle = share * 2.0 * pi;
    const Vec3 place = std::sin(angle) * hub.tangent + (1.0 - std::cos(angle)) * to_centre;
    return Pose{hub.position + length / angle * place, turned(hub.tangent, angle, axis), axis};
  });
  const double radius = length / (2.0 * pi), moment = rod.machine.rod.bending / radius;
  for (int i = 0; i < rod.machine.rod.nodes(); ++i)
    EXPECT_NEAR((rod.place(i) - radius * to_centre).norm() / radius, 1.0, 0.005);
  EXPECT_LT((rod.machine.moment_at_hub() + moment * axis).norm(), 0.01 * moment);
  EXPECT_LT(rod.machine.tip_force(rod.tip).norm(), 0.005 * moment / radius);
  EXPECT_NEAR(rod.machine.energy().bending / (pi * moment), 1.0, 0.005);
}

// An end couple bends and twists a straight rod to a helix about the couple's direction (Love, Mathematical
// Theory of Elasticity, 4th ed. 1927, Art. 270-271, without the force): it meets the tangent everywhere at
// the same angle; its part along the tangent twists, that across bends.
struct Helix {
  Pose hub;
  Vec3 axis;
  double pitch_angle, rate;  // rate: about the axis, rad/m
  double twist_rate;         // of the directors about the tangent beyond that, rad/m

  Vec3 place(double s) const {
    const Vec3 first = (hub.tangent - std::sin(pitch_angle) * axis) / rate;  // as long as the helix's radius
    return std::sin(pitch_angle) * s * axis + std::sin(rate * s) * first +
           (1.0 - std::cos(rate * s)) * axis.cross(first);
  }
  Pose pose(double s) const {
    const Vec3 director = turned(hub.director, twist_rate * s, hub.tangent);
    return {hub.position + place(s), turned(hub.tangent, rate * s, axis), turned(director, rate * s, axis)};
  }
};
Helix helix(const Pose& hub, const Rod& rod, double pitch_angle, double turns) {
  const double rate = 2.0 * pi * turns / length;
  return {hub, std::sin(pitch_angle) * hub.tangent + std::cos(pitch_angle) * hub.director, pitch_angle, rate,
          rate * rod.bending * std::sin(pitch_angle) * (1.0 / rod.torsion - 1.0 / rod.bending)};
}

TEST(RodShapes, bends_and_twists_to_loves_helix_under_an_end_couple) {
  for (const double pitch_angle : {0.3, 0.6, 1.0}) {
    constexpr double turns = 1.0;
    Clamped rod(40);
    const Rod& r = rod.machine.rod;
    rod.to([&](double share) { return helix(rod.hub, r, pitch_angle, share * turns).pose(length); });
    const Helix exact = helix(rod.hub, r, pitch_angle, turns);
    const double radius = std::cos(pitch_angle) / exact.rate, couple = r.bending * exact.rate;
    for (int i = 0; i < r.nodes(); ++i)
      EXPECT_LT((rod.place(i) - exact.place(length * i / r.edges)).norm(), 0.01 * radius) << pitch_angle;
    EXPECT_LT((rod.machine.moment_at_hub() + couple * exact.axis).norm(), 0.01 * couple);
    EXPECT_LT(rod.machine.tip_force(rod.tip).norm(), 0.01 * couple / radius);
    const double twisting = couple * std::sin(pitch_angle);
    EXPECT_NEAR(rod.machine.energy().twist / (0.5 * twisting * twisting * length / r.torsion), 1.0, 0.01);
  }
}

TEST(RodShapes, a_needle_that_grew_as_an_arc_lies_as_an_arc) {
  const Pose hub = askew();
  Machine m(straight(Support::clamped_free), 40, hub);
  constexpr double radius = 0.05;  // m
  for (int i = 0; i < m.rod.nodes(); ++i) m.rod.natural_turning[i] = {m.rod.node_length[i] / radius, 0.0};
  ASSERT_TRUE(m.rest(hub, Tip{}, 0.01));
  const Vec3 second = hub.tangent.cross(hub.director);
  const Vec3 centre = hub.position + radius * second.cross(hub.tangent);
  for (const Vec3& x : m.state.position) EXPECT_NEAR((x - centre).norm() / radius, 1.0, 0.005);
}

}  // namespace
