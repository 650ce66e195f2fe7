#include "acus/mesh/path.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "acus/base/decimal.h"
#include "acus/mesh/surface.h"

namespace acus::mesh {
namespace {

// Of a triangle: a line through a shared edge or node must meet all triangles there, whatever the rounding.
constexpr double edge_tolerance = 1e-9;
// Of the mesh's diagonal: crossings closer than this are one crossing.
constexpr double same_place_fraction = 1e-9;

struct Crossing {
  double distance;  // m along the line, from the target
  bool inward;
};

// After Moeller and Trumbore 1997.
std::optional<Crossing> crossing(const Vec3& origin, const Vec3& direction, const Vec3& a, const Vec3& b,
                                 const Vec3& c) {
  const Vec3 ab = b - a, ac = c - a;
  const Vec3 normal = ab.cross(ac);
  const double slope = direction.dot(normal);
  if (std::abs(slope) <= edge_tolerance * normal.norm()) return std::nullopt;  // along the surface
  const Vec3 from = origin - a;
  const Vec3 turn = direction.cross(from);
  const double v = ac.dot(turn) / slope, w = -ab.dot(turn) / slope;
  if (std::min({v, w, 1.0 - v - w}) < -edge_tolerance) return std::nullopt;
  return Crossing{-from.dot(normal) / slope, slope < 0.0};
}

std::vector<Crossing> crossings(const TetMesh& mesh, const Vec3& origin, const Vec3& direction) {
  std::vector<Crossing> found;
  const auto x = [&](int n) -> const Vec3& { return mesh.nodes[static_cast<std::size_t>(n)]; };
  for (const auto& [a, b, c] : boundary_triangles(mesh)) {
    if (const auto hit = crossing(origin, direction, x(a), x(b), x(c))) found.push_back(*hit);
  }
  std::sort(found.begin(), found.end(),
            [](const Crossing& p, const Crossing& q) { return p.distance < q.distance; });
  return found;
}

std::string text(const Vec3& v) {
  std::string said = "(";
  said.append(decimal_text(v.x())).append(", ").append(decimal_text(v.y())).append(", ");
  return said.append(decimal_text(v.z())).append(")");
}

}  // namespace

Result<InsertionPath> find_path(const TetMesh& mesh, const Vec3& target, const Vec3& direction) {
  if (!target.allFinite() || !direction.allFinite() || direction.norm() == 0.0) {
    return Error{"the needle's target and direction must be finite, and the direction not zero"};
  }
  const Vec3 along = direction.normalized();
  const std::vector<Crossing> all = crossings(mesh, target, along);
  const double same_place = same_place_fraction * bounds(mesh).diagonal().norm();
  std::optional<double> entry;
  for (auto first = all.begin(); first != all.end();) {
    const auto next = std::find_if(
        first, all.end(), [&](const Crossing& c) { return c.distance > first->distance + same_place; });
    const bool inward = std::any_of(first, next, [](const Crossing& c) { return c.inward; });
    const bool outward = std::any_of(first, next, [](const Crossing& c) { return !c.inward; });
    if (inward && !outward && !entry) entry = first->distance;
    if (outward && !inward && entry) {
      return InsertionPath{target + *entry * along, along, first->distance - *entry};
    }
    first = next;
  }
  const auto box = bounds(mesh);
  return Error{"the line through " + text(target) + " m along " + text(along) +
               " misses the mesh, which fills " + text(box.min()) + " to " + text(box.max()) + " m"};
}

}  // namespace acus::mesh
