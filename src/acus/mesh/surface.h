// The surface of a mesh.
#pragma once

#include <span>

#include "acus/mesh/tet_mesh.h"

namespace acus::mesh {

// Faces that only one tetrahedron has, normals pointing out of the mesh; in the order of the tetrahedra.
// Expects tetrahedra of positive volume.
std::vector<Triangle> boundary_triangles(const TetMesh& mesh);

// True if the triangles close: each edge is passed as often in one sense as in the other.
bool is_watertight(std::span<const Triangle> triangles);

}  // namespace acus::mesh
