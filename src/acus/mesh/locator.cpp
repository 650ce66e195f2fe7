#include "acus/mesh/locator.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <tuple>

namespace acus::mesh {
namespace {

constexpr int leaf_size = 4;
constexpr int deepest = 64;  // a tree halved at every level has fewer levels than an int has values
constexpr double rounding_fraction = 1e-6;

using Corners = std::array<Vec3, 4>;
using Weights = std::array<double, 4>;

std::size_t at(int i) { return static_cast<std::size_t>(i); }

Weights barycentric(const Vec3& p, const Corners& x) {
  const Weights parts = {signed_volume(p, x[1], x[2], x[3]), signed_volume(x[0], p, x[2], x[3]),
                         signed_volume(x[0], x[1], p, x[3]), signed_volume(x[0], x[1], x[2], p)};
  const double whole = parts[0] + parts[1] + parts[2] + parts[3];
  return {parts[0] / whole, parts[1] / whole, parts[2] / whole, parts[3] / whole};
}

bool lies_inside(const Weights& weights) {
  return std::all_of(weights.begin(), weights.end(), [](double w) { return w > 0.0; });
}

Vec3 combine(const Weights& w, const Corners& x) {
  return w[0] * x[0] + w[1] * x[1] + w[2] * x[2] + w[3] * x[3];
}

// Nearest point of the edge from corner i to corner j.
Weights nearest_on_edge(const Vec3& p, const Corners& x, std::size_t i, std::size_t j) {
  const Vec3 edge = x[j] - x[i];
  const double s = std::clamp((p - x[i]).dot(edge) / edge.squaredNorm(), 0.0, 1.0);
  Weights w{};
  w[i] = 1.0 - s;
  w[j] = s;
  return w;
}

// Foot of the perpendicular on the plane of a face, if it falls inside the face.
std::optional<Weights> foot_on_face(const Vec3& p, const Corners& x, const std::array<std::size_t, 3>& face) {
  const auto [a, b, c] = face;
  const Vec3 normal = (x[b] - x[a]).cross(x[c] - x[a]);
  const double squared = normal.squaredNorm();
  Weights w{};
  w[a] = normal.dot((x[b] - p).cross(x[c] - p)) / squared;
  w[b] = normal.dot((x[c] - p).cross(x[a] - p)) / squared;
  w[c] = 1.0 - w[a] - w[b];
  if (std::min({w[a], w[b], w[c]}) < 0.0) return std::nullopt;
  return w;
}

// Weights of the point of the tetrahedron nearest to p: p itself when it is inside.
Weights nearest_in_tet(const Vec3& p, const Corners& x) {
  const Weights inside = barycentric(p, x);
  if (*std::min_element(inside.begin(), inside.end()) >= 0.0) return inside;
  Weights nearest{};
  double distance = std::numeric_limits<double>::infinity();
  const auto offer = [&](const Weights& w) {
    const double d = (combine(w, x) - p).squaredNorm();
    if (d < distance) std::tie(distance, nearest) = std::tie(d, w);
  };
  for (const auto& face : tet_faces) {
    if (const auto w = foot_on_face(p, x, face)) offer(*w);
  }
  for (const auto& [i, j] : tet_edges) offer(nearest_on_edge(p, x, i, j));
  return nearest;
}

}  // namespace

Vec3 interpolate(const Embedding& e, std::span<const Vec3> values) {
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 0; i < 4; ++i) sum += e.weights[i] * values[at(e.nodes[i])];
  return sum;
}

Locator::Locator(const TetMesh& mesh)
    : nodes_(mesh.nodes),
      tets_(mesh.tets),
      order_(mesh.tets.size()),
      rounding_(rounding_fraction * bounds(mesh).diagonal().norm()) {
  std::iota(order_.begin(), order_.end(), 0);
  std::vector<Vec3> centres;
  for (const Tet& t : tets_) {
    centres.push_back((nodes_[at(t[0])] + nodes_[at(t[1])] + nodes_[at(t[2])] + nodes_[at(t[3])]) / 4.0);
  }
  boxes_.emplace_back();
  build(0, 0, static_cast<int>(tets_.size()), centres);
}

void Locator::build(int box, int begin, int end, std::vector<Vec3>& centres) {
  Eigen::AlignedBox3d around, spread;
  for (int i = begin; i < end; ++i) {
    const int tet = order_[at(i)];
    for (int node : tets_[at(tet)]) around.extend(nodes_[at(node)]);
    spread.extend(centres[at(tet)]);
  }
  boxes_[at(box)] = {around, begin, end, -1};
  if (end - begin <= leaf_size) {  // each C++ library halves into an order of its own
    std::sort(order_.begin() + begin, order_.begin() + end);
    return;
  }
  Eigen::Index axis = 0;
  spread.sizes().maxCoeff(&axis);
  const int middle = begin + (end - begin) / 2;
  std::nth_element(order_.begin() + begin, order_.begin() + middle, order_.begin() + end, [&](int p, int q) {
    return std::make_pair(centres[at(p)][axis], p) < std::make_pair(centres[at(q)][axis], q);
  });
  const int left = static_cast<int>(boxes_.size());
  boxes_[at(box)].left = left;
  boxes_.resize(boxes_.size() + 2);
  build(left, begin, middle, centres);
  build(left + 1, middle, end, centres);
}

template <class Visit>
void Locator::search(const Vec3& point, double reach_squared, Visit visit) const {
  struct Stop {
    int box;
    double distance_squared;
  };
  std::array<Stop, deepest> stack{};
  std::size_t height = 0;
  const auto push = [&](int box) {
    stack[height++] = {box, boxes_[at(box)].bounds.squaredExteriorDistance(point)};
  };
  push(0);
  while (height > 0) {
    const auto [index, distance_squared] = stack[--height];
    if (!(distance_squared <= reach_squared)) continue;
    const Box& box = boxes_[at(index)];
    if (box.left >= 0) {
      push(box.left);
      push(box.left + 1);
      if (stack[height - 1].distance_squared > stack[height - 2].distance_squared) {
        std::swap(stack[height - 1], stack[height - 2]);
      }
      continue;
    }
    for (int i = box.begin; i < box.end; ++i) reach_squared = visit(order_[at(i)], reach_squared);
  }
}

std::optional<Embedding> Locator::locate(const Vec3& point, double snap, int first) const {
  if (first >= 0) {
    const Tet& t = tets_[at(first)];
    const Weights weights =
        barycentric(point, {nodes_[at(t[0])], nodes_[at(t[1])], nodes_[at(t[2])], nodes_[at(t[3])]});
    if (lies_inside(weights)) return Embedding{first, t, weights};
  }
  return locate(point, snap);
}

std::optional<Embedding> Locator::locate(const Vec3& point, double snap) const {
  if (!point.allFinite()) return std::nullopt;
  std::optional<Embedding> found;
  bool at_the_edge = false;  // whether one will do that only touches the point or comes near
  const auto visit = [&](int tet, double reach_squared) {
    const Tet& t = tets_[at(tet)];
    const Corners corners = {nodes_[at(t[0])], nodes_[at(t[1])], nodes_[at(t[2])], nodes_[at(t[3])]};
    Weights weights = barycentric(point, corners);
    const bool inside = lies_inside(weights);
    if (!inside && !at_the_edge) return reach_squared;
    if (!inside) weights = nearest_in_tet(point, corners);
    const double d = inside ? 0.0 : (combine(weights, corners) - point).squaredNorm();
    if (d > reach_squared || (found && d == reach_squared && tet > found->tet)) return reach_squared;
    found = Embedding{tet, t, weights};
    return d;
  };
  search(point, 0.0, visit);  // most points lie inside, where the search is short
  if (found) return found;
  at_the_edge = true;
  search(point, snap * snap, visit);
  return found;
}

int Locator::nearest_node(const Vec3& point) const {
  int nearest = -1;
  search(point, std::numeric_limits<double>::infinity(), [&](int tet, double reach_squared) {
    for (int node : tets_[at(tet)]) {
      const double d = (nodes_[at(node)] - point).squaredNorm();
      if (d > reach_squared || (d == reach_squared && nearest >= 0 && node > nearest)) continue;
      nearest = node;
      reach_squared = d;
    }
    return reach_squared;
  });
  return nearest;
}

}  // namespace acus::mesh
