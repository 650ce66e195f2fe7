#include "acus/study/section.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace acus::study {
namespace {

using Face = std::array<int, 3>;  // node indices, ascending

// Face i of a tetrahedron is the one without its node i.
Face face_without(const mesh::Tet& tet, int corner) {
  Face face{};
  for (int i = 0, at = 0; i < 4; ++i) {
    if (i != corner) face[static_cast<std::size_t>(at++)] = tet[static_cast<std::size_t>(i)];
  }
  std::sort(face.begin(), face.end());
  return face;
}

// The faces that belong to one tetrahedron only, sorted.
std::vector<Face> boundary_faces(std::span<const mesh::Tet> tets) {
  std::vector<Face> faces;
  faces.reserve(4 * tets.size());
  for (const mesh::Tet& tet : tets) {
    for (int i = 0; i < 4; ++i) faces.push_back(face_without(tet, i));
  }
  std::sort(faces.begin(), faces.end());
  std::vector<Face> single;
  for (std::size_t i = 0; i < faces.size();) {
    std::size_t next = i + 1;
    while (next < faces.size() && faces[next] == faces[i]) ++next;
    if (next == i + 1) single.push_back(faces[i]);
    i = next;
  }
  return single;
}

// An edge of a tetrahedron that the plane crosses, by local node numbers, and where.
struct Crossing {
  int above = 0;
  int below = 0;
  Point2 at{};
};

// Crossings in order around the cut: neighbours share a face, that is, one of their two nodes.
std::vector<Crossing> crossings(const std::array<Point2, 4>& flat, const std::array<double, 4>& height) {
  std::vector<int> above, below;
  for (int i = 0; i < 4; ++i) (height[static_cast<std::size_t>(i)] >= 0.0 ? above : below).push_back(i);
  std::vector<Crossing> around;
  for (std::size_t a = 0; a < above.size(); ++a) {
    for (std::size_t k = 0; k < below.size(); ++k) {
      const int from = above[a], to = below[a % 2 == 0 ? k : below.size() - 1 - k];  // boustrophedon: a ring
      const auto f = static_cast<std::size_t>(from), t = static_cast<std::size_t>(to);
      const double share = height[f] / (height[f] - height[t]);
      around.push_back(
          {from,
           to,
           {flat[f][0] + share * (flat[t][0] - flat[f][0]), flat[f][1] + share * (flat[t][1] - flat[f][1])}});
    }
  }
  return around;
}

// The local node that neither crossing touches: the two lie in the face opposite to it.
int node_apart(const Crossing& a, const Crossing& b) {
  for (int i = 0; i < 4; ++i) {
    if (i != a.above && i != a.below && i != b.above && i != b.below) return i;
  }
  return -1;
}

}  // namespace

Point2 on_plane(const CutPlane& plane, const Vec3& x) {
  return {plane.right.dot(x - plane.origin), plane.up.dot(x - plane.origin)};
}

CutPlane plane_of_needle(const Vec3& entry, const Vec3& direction, std::span<const Vec3> line) {
  constexpr double straight = 1e-6;  // m: a bow below this has no side that a drawing could show
  Vec3 furthest = Vec3::Zero();
  for (const Vec3& x : line) {
    const Vec3 off = (x - entry) - direction * direction.dot(x - entry);
    if (off.norm() > furthest.norm()) furthest = off;
  }
  if (furthest.norm() < straight) {
    const Vec3 sideways = std::abs(direction.x()) < 0.9 ? Vec3::UnitX() : Vec3::UnitY();
    furthest = sideways - direction * direction.dot(sideways);
  }
  return {entry, furthest.normalized(), -direction};
}

Section cut_section(std::span<const Vec3> positions, std::span<const mesh::Tet> tets, const CutPlane& plane) {
  const std::vector<Face> surface = boundary_faces(tets);
  const Vec3 normal = plane.right.cross(plane.up);
  Section section;
  for (std::size_t e = 0; e < tets.size(); ++e) {
    std::array<Point2, 4> flat{};
    std::array<double, 4> height{};
    for (std::size_t i = 0; i < 4; ++i) {
      const Vec3& x = positions[static_cast<std::size_t>(tets[e][i])];
      flat[i] = on_plane(plane, x);
      height[i] = normal.dot(x - plane.origin);
    }
    const std::vector<Crossing> around = crossings(flat, height);
    if (around.empty()) continue;
    CutPolygon polygon{static_cast<int>(e), static_cast<int>(around.size()), {}};
    for (std::size_t i = 0; i < around.size(); ++i) polygon.corner[i] = around[i].at;
    // Where the plane only touches a corner or an edge there is nothing to fill, but the outline may run
    // along it.
    if (area(polygon) > 0.0) section.polygons.push_back(polygon);
    for (std::size_t i = 0; i < around.size(); ++i) {
      const Crossing& next = around[(i + 1) % around.size()];
      const Face face = face_without(tets[e], node_apart(around[i], next));
      if (around[i].at != next.at && std::binary_search(surface.begin(), surface.end(), face))
        section.outline.push_back({around[i].at, next.at});
    }
  }
  return section;
}

double area(const CutPolygon& polygon) {
  double twice = 0.0;
  for (int i = 0; i < polygon.corners; ++i) {
    const Point2& p = polygon.corner[static_cast<std::size_t>(i)];
    const Point2& q = polygon.corner[static_cast<std::size_t>((i + 1) % polygon.corners)];
    twice += p[0] * q[1] - q[0] * p[1];
  }
  return std::abs(twice) / 2.0;
}

}  // namespace acus::study
