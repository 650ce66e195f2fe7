// Where a straight needle would go into a mesh, and where it would come out.
#pragma once

#include "acus/base/result.h"
#include "acus/mesh/tet_mesh.h"

namespace acus::mesh {

struct InsertionPath {
  Vec3 entry;           // m, on the surface
  Vec3 direction;       // unit vector, into the mesh
  double length = 0.0;  // m, from the entry to the first exit
};

// The needle comes from far outside along `direction` (any length but zero) on the line through `target` [m];
// the first surface it passes into is its entry, the next it passes out of ends the path. Surfaces that it
// only grazes do not count. Error: the line misses the mesh, or target or direction make no line.
Result<InsertionPath> find_path(const TetMesh& mesh, const Vec3& target, const Vec3& direction);

}  // namespace acus::mesh
