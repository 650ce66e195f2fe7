#include "acus/needle/rod.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

#include "acus/numeric/circular.h"

namespace acus::needle {
namespace {

// Curvature [1/m] of the unloaded bow at arc length s.
double bow_curvature(const NeedleSpec& spec, bool hub_clamped, double s) {
  const double wave = (hub_clamped ? 2.0 : 1.0) * std::numbers::pi / spec.length;
  const double amplitude = (hub_clamped ? 0.5 : 1.0) * spec.imperfection;
  const double phase = wave * s;
  return amplitude * wave * wave * (hub_clamped ? numeric::cos(phase) : -numeric::sin(phase));
}

struct Turn {
  double cos, sin;
};
// For what a section turns in a step, by the first terms of Taylor's series: what is left out of them is
// below 1e-18.
Turn turn_by(double angle) {
  if (std::abs(angle) > 0.0625) return {numeric::cos(angle), numeric::sin(angle)};
  const double s = angle * angle;
  double cos = 1.0, sin = 1.0;
  for (const double n : {1.0 / 90.0, 1.0 / 56.0, 1.0 / 30.0, 1.0 / 12.0, 1.0 / 2.0}) cos = 1.0 - n * s * cos;
  for (const double n : {1.0 / 72.0, 1.0 / 42.0, 1.0 / 20.0, 1.0 / 6.0}) sin = 1.0 - n * s * sin;
  return {cos, angle * sin};
}

}  // namespace

Rod build_rod(const NeedleSpec& spec, int edges, double poisson_ratio) {
  assert(edges >= 2 && spec.length > 0.0 && spec.radius > 0.0);
  Rod rod;
  rod.edges = edges;
  rod.axial = axial_rigidity(spec);
  rod.bending = bending_rigidity(spec);
  rod.torsion = rod.bending / (1.0 + poisson_ratio);
  rod.hub_clamped = spec.support != Support::pinned_pinned;
  rod.tip_clamped = spec.support == Support::clamped_clamped;
  const double l = spec.length / edges;
  const double mass = spec.density * section_area(spec) * l;
  rod.edge_length.assign(edges, l);
  rod.edge_inertia.assign(edges,
                          0.5 * mass * (spec.radius * spec.radius + spec.inner_radius * spec.inner_radius));
  rod.node_length.assign(rod.nodes(), l);
  rod.node_mass.assign(rod.nodes(), mass);
  for (auto* ends : {&rod.node_length, &rod.node_mass}) ends->front() = ends->back() = 0.5 * ends->front();
  for (int i = 0; i < rod.nodes(); ++i)
    rod.natural_turning.push_back({rod.node_length[i] * bow_curvature(spec, rod.hub_clamped, i * l), 0.0});
  return rod;
}

RodState unloaded_rod(const Rod& rod, const Pose& hub) {
  RodState s;
  s.position.push_back(hub.position);
  Vec3 tangent = hub.tangent, director = hub.director;
  for (int j = 0; j < rod.edges; ++j) {
    if (j > 0 || rod.hub_clamped) {  // k1 = kb . d2, k2 = -kb . d1, |kb| = 2 tan(turning / 2)
      const auto [k1, k2] = rod.natural_turning[j];
      const Vec3 kb = k1 * tangent.cross(director) - k2 * director;
      const double square = 0.25 * kb.squaredNorm();
      const Vec3 next = ((1.0 - square) * tangent + kb.cross(tangent)) / (1.0 + square);
      director = transported(director, tangent, next);
      tangent = next;
    }
    s.position.push_back(s.position.back() + rod.edge_length[j] * tangent);
    s.director.push_back(director);
  }
  s.rate.assign(rod.unknowns(), 0.0);
  if (rod.hub_clamped) return s;
  // A joint lets the needle hang with its tip on the hub's axis.
  const Vec3 chord = (s.position.back() - hub.position).normalized();
  for (Vec3& x : s.position) x = hub.position + transported(x - hub.position, chord, hub.tangent);
  for (Vec3& d : s.director) d = transported(d, chord, hub.tangent);
  return s;
}

void displace(RodState& s, const Rod& rod, const std::vector<double>& change) {
  Vec3 last = s.position[0];  // where the node before was
  const auto step = [&](int node) {
    const double* const by = &change[place_at(node)];
    s.position[node] += Vec3(by[0], by[1], by[2]);
  };
  step(0);
  for (int j = 0; j < rod.edges; ++j) {
    const Vec3 here = s.position[j + 1];
    step(j + 1);
    const Vec3 before = (here - last).normalized(), tangent = edge(s, j).normalized();
    last = here;
    const Turn turn = turn_by(change[spin_at(j)]);
    const Vec3 carried = transported(s.director[j], before, tangent);
    const Vec3 turned = turn.cos * carried + turn.sin * tangent.cross(carried);
    const Vec3 across = turned - turned.dot(tangent) * tangent;
    s.director[j] = (1.5 - 0.5 * across.squaredNorm()) * across;  // unit again: rounding does not add up
  }
}

RodPoint point_at_arc(const Rod& rod, double s) {
  const double l = rod.edge_length.front();
  const int j = std::clamp(static_cast<int>(s / l), 0, rod.edges - 1);
  return {j, std::clamp(s / l - j, 0.0, 1.0)};
}

Vec3 place_of(const RodState& s, const RodPoint& p) {
  return s.position[p.edge] + p.along * (s.position[p.edge + 1] - s.position[p.edge]);
}

}  // namespace acus::needle
