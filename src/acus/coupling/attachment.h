// Where a point of the needle holds on to the tissue: weights of nodes (paper Eq. 8-9 and its better
// reading).
//
// The same weights carry the motion of the nodes to the point and the force at the point back to the nodes,
// so action equals reaction and the coupling makes no energy.
#pragma once

#include <cmath>
#include <numbers>
#include <span>
#include <vector>

#include "acus/base/vec.h"
#include "acus/mesh/locator.h"
#include "acus/numeric/circular.h"
#include "acus/numeric/node_vector.h"

namespace acus::coupling {

// Weights of the free nodes among those that hold a point; held nodes do not move and are left out.
struct Attachment {
  std::vector<int> node;
  std::vector<double> weight;  // at least 0, sum to 1 over free and held nodes
  // The tetrahedra that held the points of a disc when it was attached here before, -1 where none did: they
  // are tried first.
  std::vector<int> last;

  void reserve(int entries) { node.reserve(entries), weight.reserve(entries); }
  void clear() { node.clear(), weight.clear(); }
  bool empty() const { return node.empty(); }
};

// A tip load is spread evenly over a disc by rings of 4, 8, 12 ... points, each standing for the same area:
// their spacing is the radius over the number of rings, and must stay below the elements' size, or the disc
// becomes a handful of point loads, which have no limit.
inline constexpr int fewest_rings = 3;
inline constexpr int most_rings = 16;
inline constexpr int points_of(int rings) { return 2 * rings * (rings + 1); }
int rings_for(double radius, double shortest_edge);

// Calls `visit` with each of those points, ring by ring.
template <class Visit>
void visit_disc(const Vec3& centre, const Vec3& axis, double radius, int rings, const Visit& visit) {
  const Vec3 u = axis.unitOrthogonal(), v = axis.cross(u);
  for (int ring = 1; ring <= rings; ++ring) {
    const int ring_points = 4 * ring;
    // Half of the ring's area lies inside this radius.
    const double r = radius * std::sqrt((points_of(ring) - 0.5 * ring_points) / points_of(rings));
    for (int i = 0; i < ring_points; ++i) {
      const double angle = 2.0 * std::numbers::pi * (i + 0.5) / ring_points;
      visit(Vec3(centre + r * (numeric::cos(angle) * u + numeric::sin(angle) * v)));
    }
  }
}

// The point's own tetrahedron, barycentric. Nothing when it lies farther than `snap` [m] outside the mesh.
void embed_point_into(Attachment& out, const mesh::Locator& locator, const Vec3& point, double snap,
                      int free_nodes);
// Mean over a disc of `radius` [m] across `axis` (unit); its points outside the mesh are dropped.
void embed_disc_into(Attachment& out, const mesh::Locator& locator, const Vec3& centre, const Vec3& axis,
                     double radius, int free_nodes, int rings = fewest_rings);
// The paper's: one node, the one nearest to the point at rest.
void attach_to_nearest_node_into(Attachment& out, const mesh::Locator& locator, const Vec3& point,
                                 int free_nodes);

// The weighted mean of a nodal field; zero for an empty attachment.
template <class Real>
Vec3 mean(const Attachment& at, const numeric::NodeVectorOf<Real>& field) {
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 0; i < at.node.size(); ++i)
    sum += at.weight[i] * numeric::at(field, at.node[i]).template cast<double>();
  return sum;
}
Vec3 displacement(const Attachment& at, std::span<const Vec3> positions, std::span<const Vec3> rest);
// Adds `amount`, spread by the weights, to a nodal field.
template <class Real>
void add_spread(numeric::NodeVectorOf<Real>& field, const Attachment& at, const Vec3& amount) {
  for (std::size_t i = 0; i < at.node.size(); ++i)
    numeric::at(field, at.node[i]) += (at.weight[i] * amount).template cast<Real>();
}

// Component along `axis` of the weighted mean of a nodal field.
template <class Real>
double along(const Attachment& at, const numeric::NodeVectorOf<Real>& field, const Vec3& axis) {
  double sum = 0.0;
  for (std::size_t i = 0; i < at.node.size(); ++i)
    sum += at.weight[i] * axis.dot(numeric::at(field, at.node[i]).template cast<double>());
  return sum;
}
double displacement_along(const Attachment& at, std::span<const Vec3> positions, std::span<const Vec3> rest,
                          const Vec3& axis);
// Adds `amount` along `axis`, spread by the weights, to a nodal field.
template <class Real>
void add_along(numeric::NodeVectorOf<Real>& field, const Attachment& at, double amount, const Vec3& axis) {
  for (std::size_t i = 0; i < at.node.size(); ++i)
    numeric::at(field, at.node[i]) += (at.weight[i] * amount * axis).template cast<Real>();
}

}  // namespace acus::coupling
