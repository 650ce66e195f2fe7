// A mesh that came from outside, made fit for computing with, or refused with a sentence.
#pragma once

#include <functional>
#include <string>

#include "acus/base/result.h"
#include "acus/mesh/tet_mesh.h"

namespace acus::mesh {

// Names a tetrahedron in a sentence: "liver.msh:214: element 17".
using TetName = std::function<std::string(int tet)>;

// The mesh with every tetrahedron of positive volume (inverted ones have two corners swapped), and without
// the nodes that no tetrahedron uses (they would have no mass); the order of the others stays.
// Error, naming the tetrahedron: an index out of range, a corner used twice, a coordinate that is not finite,
// a flat tetrahedron (height below 1e-6 of its longest edge), two tetrahedra on one side of a face, or a mesh
// in pieces that no face joins. Such pieces mostly come from nodes that were not merged where regions meet,
// where the tissue would silently tear; a piece that hangs by an edge or a node is a hinge, and one that
// nothing holds falls away.
Result<TetMesh> checked(TetMesh mesh, const TetName& name_of);
Result<TetMesh> checked(TetMesh mesh);  // "tetrahedron 17", counted from 0

}  // namespace acus::mesh
