// A tetrahedral mesh: geometry without physics.
#pragma once

#include <array>
#include <vector>

#include "acus/base/vec.h"

namespace acus::mesh {

using Tet = std::array<int, 4>;       // node indices; positive volume: det(x1-x0, x2-x0, x3-x0) > 0
using Triangle = std::array<int, 3>;  // node indices; normal (x1-x0) x (x2-x0) points out of the mesh

// The faces of a tetrahedron of positive volume, by corner; face i lies opposite corner i and its normal
// points out.
inline constexpr std::array<std::array<std::size_t, 3>, 4> tet_faces = {
    {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}};
inline constexpr std::array<std::array<std::size_t, 2>, 6> tet_edges = {
    {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}}};

struct TetMesh {
  std::vector<Vec3> nodes;  // m
  std::vector<Tet> tets;
  std::vector<int> region;  // one per tetrahedron: which material; 0 where the file names none
};

// Six times the volume is det(x1-x0, x2-x0, x3-x0); negative when the tetrahedron is inverted. m^3
double signed_volume(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);
double signed_volume(const TetMesh& mesh, const Tet& tet);
// Sum of the signed volumes. m^3
double total_volume(const TetMesh& mesh);
// Smallest box with sides along the axes that holds every node; empty for a mesh without nodes. m
Eigen::AlignedBox3d bounds(const TetMesh& mesh);

}  // namespace acus::mesh
