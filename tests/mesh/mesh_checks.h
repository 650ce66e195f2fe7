// Facts about a mesh that tests check by counting, apart from the code under test.
#pragma once

#include <algorithm>
#include <array>
#include <map>
#include <set>

#include "acus/mesh/tet_mesh.h"

namespace acus::mesh {

inline std::map<std::array<int, 3>, int> face_counts(const TetMesh& mesh) {
  std::map<std::array<int, 3>, int> counts;
  for (const Tet& t : mesh.tets) {
    for (const auto& [a, b, c] : tet_faces) {
      std::array<int, 3> face = {t[a], t[b], t[c]};
      std::sort(face.begin(), face.end());
      ++counts[face];
    }
  }
  return counts;
}

inline long edge_count(const TetMesh& mesh) {
  std::set<std::pair<int, int>> edges;
  for (const Tet& t : mesh.tets) {
    for (const auto& [i, j] : tet_edges) edges.insert(std::minmax(t[i], t[j]));
  }
  return static_cast<long>(edges.size());
}

// nodes - edges + faces - tetrahedra: 1 for anything that is one solid ball.
inline long euler_characteristic(const TetMesh& mesh) {
  return static_cast<long>(mesh.nodes.size()) - edge_count(mesh) +
         static_cast<long>(face_counts(mesh).size()) - static_cast<long>(mesh.tets.size());
}

// Area of the faces that only one tetrahedron has: grows when a refinement leaves a node hanging. m^2
inline double free_face_area(const TetMesh& mesh) {
  double area = 0.0;
  for (const auto& [face, count] : face_counts(mesh)) {
    if (count != 1) continue;
    const auto x = [&mesh, &corners = face](std::size_t i) {
      return mesh.nodes[static_cast<std::size_t>(corners[i])];
    };
    area += 0.5 * (x(1) - x(0)).cross(x(2) - x(0)).norm();
  }
  return area;
}

inline int most_tets_on_a_face(const TetMesh& mesh) {
  int most = 0;
  for (const auto& [face, count] : face_counts(mesh)) most = std::max(most, count);
  return most;
}

inline double smallest_volume(const TetMesh& mesh) {
  double smallest = 1e300;
  for (const Tet& t : mesh.tets) smallest = std::min(smallest, signed_volume(mesh, t));
  return smallest;
}

}  // namespace acus::mesh
