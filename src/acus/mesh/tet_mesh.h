// A tetrahedral mesh: geometry without physics.
#pragma once

#include <array>
#include <vector>

#include "acus/base/vec.h"

namespace acus::mesh {

using Tet = std::array<int, 4>;       // node indices; positive volume: det(x1-x0, x2-x0, x3-x0) > 0
using Triangle = std::array<int, 3>;  // node indices; normal (x1-x0) x (x2-x0) points out of the mesh

struct TetMesh {
  std::vector<Vec3> nodes;  // m
  std::vector<Tet> tets;
  std::vector<int> region;  // one per tetrahedron: which material; 0 where the file names none
};

// Six times the volume is det(x1-x0, x2-x0, x3-x0); negative when the tetrahedron is inverted. m^3
double signed_volume(const TetMesh& mesh, const Tet& tet);

}  // namespace acus::mesh
