#include "acus/coupling/attachment.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "acus/numeric/circular.h"

namespace acus::coupling {
namespace {

void add_weight(Attachment& out, int node, double weight, int free_nodes) {
  if (node >= free_nodes || weight == 0.0) return;
  const auto known = std::find(out.node.begin(), out.node.end(), node);
  if (known != out.node.end()) {
    out.weight[known - out.node.begin()] += weight;
    return;
  }
  out.node.push_back(node);
  out.weight.push_back(weight);
}

// Two unit vectors across the axis.
std::pair<Vec3, Vec3> across(const Vec3& axis) {
  const Vec3 u = axis.unitOrthogonal();
  return {u, axis.cross(u)};
}

}  // namespace

void embed_point_into(Attachment& out, const mesh::Locator& locator, const Vec3& point, double snap,
                      int free_nodes) {
  out.clear();
  if (const auto at = locator.locate(point, snap))
    for (int i = 0; i < 4; ++i) add_weight(out, at->nodes[i], at->weights[i], free_nodes);
}

int rings_for(double radius, double shortest_edge) {
  return std::clamp(static_cast<int>(std::ceil(radius / shortest_edge)), fewest_rings, most_rings);
}

void embed_disc_into(Attachment& out, const mesh::Locator& locator, const Vec3& centre, const Vec3& axis,
                     double radius, int free_nodes, int rings) {
  out.clear();
  const auto [u, v] = across(axis);
  int inside = 0;
  for (int ring = 1; ring <= rings; ++ring) {
    const int ring_points = 4 * ring;
    // Half of the ring's area lies inside this radius.
    const double r = radius * std::sqrt((points_of(ring) - 0.5 * ring_points) / points_of(rings));
    for (int i = 0; i < ring_points; ++i) {
      const double angle = 2.0 * std::numbers::pi * (i + 0.5) / ring_points;
      const Vec3 point = centre + r * (numeric::cos(angle) * u + numeric::sin(angle) * v);
      const auto at = locator.locate(point, radius);  // a curved surface may pass below or above the disc
      if (!at) continue;
      ++inside;
      for (std::size_t c = 0; c < 4; ++c) add_weight(out, at->nodes[c], at->weights[c], free_nodes);
    }
  }
  for (double& w : out.weight) w /= inside;
}

void attach_to_nearest_node_into(Attachment& out, const mesh::Locator& locator, const Vec3& point,
                                 int free_nodes) {
  out.clear();
  add_weight(out, locator.nearest_node(point), 1.0, free_nodes);
}

Vec3 displacement(const Attachment& at, std::span<const Vec3> positions, std::span<const Vec3> rest) {
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 0; i < at.node.size(); ++i)
    sum += at.weight[i] * (positions[at.node[i]] - rest[at.node[i]]);
  return sum;
}

double displacement_along(const Attachment& at, std::span<const Vec3> positions, std::span<const Vec3> rest,
                          const Vec3& axis) {
  double sum = 0.0;
  for (std::size_t i = 0; i < at.node.size(); ++i)
    sum += at.weight[i] * axis.dot(positions[at.node[i]] - rest[at.node[i]]);
  return sum;
}

}  // namespace acus::coupling
