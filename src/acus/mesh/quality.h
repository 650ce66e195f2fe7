// How well shaped tetrahedra are: slivers make a stiff, badly conditioned system.
#pragma once

#include "acus/mesh/tet_mesh.h"

namespace acus::mesh {

// Smallest of the six angles between two faces, rad: 1.2310 (70.53 deg) for the regular tetrahedron, 0 for a
// flat one.
double smallest_dihedral_angle(const TetMesh& mesh, const Tet& tet);
// Longest edge over the smallest height, scaled so that the regular tetrahedron has 1; infinite for a flat
// one.
double aspect_ratio(const TetMesh& mesh, const Tet& tet);

struct Quality {
  double smallest_dihedral_angle = 0.0;  // rad, worst tetrahedron
  double largest_aspect_ratio = 0.0;     // worst tetrahedron
  double shortest_edge = 0.0;            // m
  double longest_edge = 0.0;             // m
};

// Worst values over a mesh of at least one tetrahedron.
Quality quality(const TetMesh& mesh);

}  // namespace acus::mesh
