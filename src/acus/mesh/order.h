// Numbering for locality: a step walks the mesh many times, and neighbours in space should be neighbours in
// memory.
#pragma once

#include "acus/mesh/tet_mesh.h"

namespace acus::mesh {

// The same mesh with its nodes in reverse Cuthill-McKee order (Cuthill and McKee 1969, George 1971), which
// keeps the numbers of connected nodes close, and its tetrahedra sorted by their lowest nodes. The order of
// the four corners within a tetrahedron stays. Deterministic: equals are taken in their present order.
TetMesh ordered_for_locality(const TetMesh& mesh);

// Largest and mean difference between the numbers of two nodes that share a tetrahedron.
struct NodeSpread {
  int largest = 0;  // the half bandwidth of the mesh's stiffness matrix, in nodes
  double mean = 0.0;
};
NodeSpread node_spread(const TetMesh& mesh);

}  // namespace acus::mesh
