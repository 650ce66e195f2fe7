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
  out.last.resize(points_of(rings), -1);
  auto last = out.last.begin();
  int inside = 0;
  visit_disc(centre, axis, radius, rings, [&](const Vec3& point) {
    int& tet = *last++;
    const auto at = locator.locate(point, radius, tet);  // a curved surface may pass below or above the disc
    tet = at ? at->tet : -1;
    if (!at) return;
    ++inside;
    for (std::size_t c = 0; c < 4; ++c) add_weight(out, at->nodes[c], at->weights[c], free_nodes);
  });
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
