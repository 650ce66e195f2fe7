#include "acus/mesh/quality.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace acus::mesh {
namespace {

const Vec3& corner(const TetMesh& mesh, const Tet& tet, std::size_t i) {
  return mesh.nodes[static_cast<std::size_t>(tet[i])];
}

// Twice the area of each face times its outward unit normal.
std::array<Vec3, 4> face_normals(const TetMesh& mesh, const Tet& tet) {
  std::array<Vec3, 4> normals;
  for (std::size_t f = 0; f < 4; ++f) {
    const auto [a, b, c] = tet_faces[f];
    const Vec3& origin = corner(mesh, tet, a);
    normals[f] = (corner(mesh, tet, b) - origin).cross(corner(mesh, tet, c) - origin);
  }
  return normals;
}

std::pair<double, double> edge_range(const TetMesh& mesh, const Tet& tet) {
  double shortest = std::numeric_limits<double>::infinity();
  double longest = 0.0;
  for (const auto& [i, j] : tet_edges) {
    const double length = (corner(mesh, tet, i) - corner(mesh, tet, j)).norm();
    shortest = std::min(shortest, length);
    longest = std::max(longest, length);
  }
  return {shortest, longest};
}

}  // namespace

double smallest_dihedral_angle(const TetMesh& mesh, const Tet& tet) {
  const auto normals = face_normals(mesh, tet);
  double smallest = std::numbers::pi;
  for (const auto& [i, j] : tet_edges) {
    const double angle = std::atan2(normals[i].cross(normals[j]).norm(), -normals[i].dot(normals[j]));
    smallest = std::min(smallest, angle);
  }
  return smallest;
}

double aspect_ratio(const TetMesh& mesh, const Tet& tet) {
  double largest_face = 0.0;  // twice its area
  for (const Vec3& n : face_normals(mesh, tet)) largest_face = std::max(largest_face, n.norm());
  const double smallest_height = 6.0 * std::abs(signed_volume(mesh, tet)) / largest_face;
  return edge_range(mesh, tet).second / smallest_height * std::sqrt(2.0 / 3.0);
}

Quality quality(const TetMesh& mesh) {
  Quality worst{std::numbers::pi, 0.0, std::numeric_limits<double>::infinity(), 0.0};
  for (const Tet& tet : mesh.tets) {
    const auto [shortest, longest] = edge_range(mesh, tet);
    worst.smallest_dihedral_angle =
        std::min(worst.smallest_dihedral_angle, smallest_dihedral_angle(mesh, tet));
    worst.largest_aspect_ratio = std::max(worst.largest_aspect_ratio, aspect_ratio(mesh, tet));
    worst.shortest_edge = std::min(worst.shortest_edge, shortest);
    worst.longest_edge = std::max(worst.longest_edge, longest);
  }
  return worst;
}

}  // namespace acus::mesh
