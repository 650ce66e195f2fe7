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

NeedleSpec cantilever() {
  NeedleSpec spec;  // Table I
  spec.support = Support::clamped_free;
  spec.imperfection = 0.0;
  return spec;
}

Pose askew() {
  Pose pose;
  pose.tangent = Vec3(2.0, -1.0, 2.0) / 3.0;
  pose.director = Vec3(1.0, 2.0, 0.0).normalized();
  return pose;
}

// Puts the load on little by little, and waits for rest each time.
void load(Machine& m, const Pose& hub, const Tip& tip, int parts) {
  const double h = std::getenv("HH") ? atof(std::getenv("HH")) : 0.1; if(std::getenv("PP")) parts=atoi(std::getenv("PP"));
  for (int part = 1; part <= parts; ++part) {
    Tip some = tip;
    some.force *= static_cast<double>(part) / parts;
    some.moment *= static_cast<double>(part) / parts;
    ASSERT_TRUE(m.rest(hub, some, h)) << "part " << part;
  }
}

struct Deflected {
  double load;              // P L^2 / EI, across the unloaded rod
  double across, along;     // of the tip, / L; towards the load and towards the clamp
  double slope;             // of the tip, rad
};

// The elastica through elliptic integrals, from the slope of its tip (Bisshopp and Drucker, Quarterly of Applied
// Mathematics 3, 1945).
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
  for (const Deflected& published : mattiasson) {
    const Pose hub = askew();
    Machine m(cantilever(), 40, hub);
    const double length = cantilever().length;
    const Vec3 across = hub.tangent.cross(hub.director);
    Tip tip;
    tip.force = published.load * m.rod.bending / (length * length) * across;
    load(m, hub, tip, 4);
    const Vec3 end = (m.state.position.back() - hub.position) / length;
    const Vec3 last = edge(m.state, m.rod.edges - 1).normalized();
    std::printf("%g %g %g\n", end.dot(across)- published.across,1.0 - end.dot(hub.tangent)- published.along,std::acos(last.dot(hub.tangent))- published.slope);
    EXPECT_NEAR(end.dot(across), published.across, 1e-3);
    EXPECT_NEAR(1.0 - end.dot(hub.tangent), published.along, 1e-3);
    EXPECT_NEAR(std::acos(last.dot(hub.tangent)), published.slope, 1e-3);
    EXPECT_LT(std::abs(end.dot(hub.director)), 1e-9);
    EXPECT_LT((m.hub_force() + tip.force).norm(), 1e-4 * tip.force.norm());
  }
}

TEST(RodShapes, an_end_moment_rolls_it_up_to_a_circle) {
  const Pose hub = askew();
  Machine m(cantilever(), 40, hub);
  const double length = cantilever().length, radius = length / (2.0 * pi);
  Tip tip;
  tip.moment = m.rod.bending / radius * hub.director;
  load(m, hub, tip, 8);
  const Vec3 centre = hub.position + radius * hub.director.cross(hub.tangent);
  for (const Vec3& x : m.state.position) EXPECT_NEAR((x - centre).norm() / radius, 1.0, 0.01);
  std::printf("%g %g\n", (m.state.position.back() - hub.position).norm() / radius, m.energy().bending / (2.0 * pi * pi * m.rod.bending / length));
  EXPECT_LT((m.state.position.back() - hub.position).norm(), 0.02 * radius);
  EXPECT_NEAR(m.energy().bending / (2.0 * pi * pi * m.rod.bending / length), 1.0, 0.02);
  EXPECT_LT((m.moment_at_hub() + tip.moment).norm(), 0.01 * tip.moment.norm());
}

TEST(RodShapes, a_needle_that_grew_as_an_arc_lies_as_an_arc) {
  const Pose hub = askew();
  Machine m(cantilever(), 40, hub);
  constexpr double radius = 0.05;  // m
  for (int i = 0; i < m.rod.nodes(); ++i) m.rod.natural_turning[i] = {m.rod.node_length[i] / radius, 0.0};
  for(int i=0;i<300;++i){auto n=m.step(hub,Tip{},atof(std::getenv("HH"))); if(i<10||i%50==0) std::printf("%d ",n?*n:-1);}
  const Vec3 second = hub.tangent.cross(hub.director);  // which k1 turns about
  const Vec3 centre = hub.position + radius * second.cross(hub.tangent);
  for (const Vec3& x : m.state.position) EXPECT_NEAR((x - centre).norm() / radius, 1.0, 0.01);
  EXPECT_LT(total(m.energy()), 1e-4 * m.rod.bending / radius);
}

// An end couple alone bends and twists a straight rod to a helix about the couple's direction (Love, Mathematical
// Theory of Elasticity, 4th ed. 1927, Art. 270-271, without the force): it meets the tangent everywhere at the
// clamp's angle, and its part along the tangent twists, that across bends.
TEST(RodShapes, an_end_couple_winds_it_to_loves_helix) {
  const Pose hub = askew();
  for (const double pitch_angle : {0.3, 0.6, 1.0}) {
    Machine m(cantilever(), 80, hub);
    const double length = cantilever().length, turns = 2.0;
    const Vec3 axis = std::sin(pitch_angle) * hub.tangent + std::cos(pitch_angle) * hub.director;
    const double rate = 2.0 * pi * turns / length;  // of turning about the axis, rad/m
    const double couple = m.rod.bending * rate;
    Tip tip;
    tip.moment = couple * axis;
    load(m, hub, tip, 20);
    const double radius = std::cos(pitch_angle) / rate;
    const Vec3 first = hub.tangent - std::sin(pitch_angle) * axis;
    const Vec3 second = axis.cross(first);
    double worst = 0;
    for (int i = 0; i < m.rod.nodes(); ++i) {
      const double s = i * m.rod.edge_length[0], phase = rate * s;
      const Vec3 exact = std::sin(pitch_angle) * s * axis +
                         (std::sin(phase) * first + (1.0 - std::cos(phase)) * second) / rate;
      worst=std::max(worst,(m.state.position[i] - hub.position - exact).norm()/radius);
      EXPECT_LT((m.state.position[i] - hub.position - exact).norm(), 0.01 * radius) << pitch_angle << ' ' << i;
    }
    const double twisting = couple * std::sin(pitch_angle);
    std::printf("%g %g\n",worst,m.energy().twist / (0.5 * twisting * twisting * length / m.rod.torsion));
    EXPECT_NEAR(m.energy().twist / (0.5 * twisting * twisting * length / m.rod.torsion), 1.0, 0.01);
  }
}

}  // namespace
