// The needle as a geometrically exact rod: bending about two axes, stretch and twist, at any rotation.
//
// A discrete elastic rod (Bergou et al., ACM TOG 27(3), 2008 and 29(4), 2010): nodes x_i joined by edges
// e_i = x_{i+1} - x_i, and across every edge a unit vector, its director, that tells how far the section has
// turned about the axis. With unit tangents t, c = t_{i-1} . t_i and the curvature binormal kb_i = 2 t_{i-1}
// x t_i / (1 + c):
//   stretch  EA/2 sum_j l_j (|e_j| / l_j - 1)^2
//   bending  EI/2 sum_i |kb_i|^2 / l_i - EI sum_i k0_i . k_i / l_i,   |kb_i| = 2 tan(turning / 2),
//            k_i the binormal in the directors, k0_i the same of the unloaded needle
//   twist    GJ/2 sum_i m_i^2 / l_i,   m_i the director's turn from edge i-1 to edge i.
// l_j is the rest length of edge j, l_i that of the half edges beside node i. Errors fall with the square of
// l.
//
// Node 0 is held by whoever leads the hub. Where the hub clamps, it also holds the tangent there, by half an
// edge that lies in the hub; so may the tip's.
#pragma once

#include <array>
#include <vector>

#include "acus/base/vec.h"
#include "acus/needle/needle_spec.h"

namespace acus::needle {

// What holds an end: where it is, and which way a needle lies in it.
struct Pose {
  Vec3 position{0.0, 0.0, 0.0};  // m
  Vec3 tangent{0.0, 0.0, -1.0};  // unit, hub to tip
  Vec3 director{1.0, 0.0, 0.0};  // unit, across the tangent
};

// Constants of one rod.
struct Rod {
  int edges = 0;
  double axial = 0.0;                // EA, N
  double bending = 0.0;              // EI, N m^2
  double torsion = 0.0;              // GJ, N m^2
  bool hub_clamped = true;           // else the hub is a joint that holds the place and hinders only spinning
  bool tip_clamped = false;          // the tip's tangent is led as well
  std::vector<double> edge_length;   // [edges] m, unloaded
  std::vector<double> node_length;   // [nodes] m, of the half edges that meet there
  std::vector<double> node_mass;     // [nodes] kg
  std::vector<double> edge_inertia;  // [edges] kg m^2, about the axis
  std::vector<std::array<double, 2>> natural_turning;  // [nodes] k0, rad

  int nodes() const { return edges + 1; }
  int unknowns() const { return 4 * edges + 3; }
};
// Where rates stand among the unknowns, hub to tip: three of node i, and the spin of edge j.
inline constexpr int place_at(int node) { return 4 * node; }
inline constexpr int spin_at(int edge) { return 4 * edge + 3; }
inline constexpr bool is_spin(int unknown) { return unknown % 4 == 3; }

// `edges` >= 2 of equal length. The unloaded needle has a bow of the amplitude spec.imperfection in the plane
// of the directors: half a sine wave where the hub is pinned, a whole wave of 1 - cos where it is clamped.
// Poisson's ratio `poisson_ratio` of the needle's material gives GJ = EI / (1 + poisson_ratio), for a round
// section.
Rod build_rod(const NeedleSpec& spec, int edges, double poisson_ratio = 0.3);

struct RodState {
  std::vector<Vec3> position;  // [nodes] m
  std::vector<Vec3> director;  // [edges] unit, across the edge
  std::vector<double> rate;    // [unknowns] m/s and rad/s
};

// At rest and unloaded, with its natural turning, in the hub.
RodState unloaded_rod(const Rod& rod, const Pose& hub);

inline Vec3 edge(const RodState& s, int j) { return s.position[j + 1] - s.position[j]; }

// Shortest rotation from the direction of unit vector `from` to that of `to`, applied to v: two reflections.
// Not defined for opposite ones.
inline Vec3 transported(const Vec3& v, const Vec3& from, const Vec3& to) {
  const Vec3 both = from + to;
  return v - (both.dot(v) / (1.0 + from.dot(to))) * both + (2.0 * from.dot(v)) * to;
}

// Moves the rod on by `change` [unknowns, m and rad]: directors go with their edges by the shortest rotation
// and then turn by the spin.
void displace(RodState& state, const Rod& rod, const std::vector<double>& change);

// The rod's curve: point at arc length s [m] of the unloaded needle from the hub, 0 <= s <= length.
struct RodPoint {
  int edge = 0;
  double along = 0.0;  // 0 at the edge's first node, 1 at its second
};
RodPoint point_at_arc(const Rod& rod, double s);
Vec3 place_of(const RodState& state, const RodPoint& point);

}  // namespace acus::needle
