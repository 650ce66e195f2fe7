// Local refinement of any tetrahedral mesh, conforming, by bisection of longest edges.
//
// A tetrahedron is divided only by halving its longest edge, and an edge is halved only together with every
// tetrahedron around it, once it is the longest edge of each. Where a neighbour has a longer edge, that one
// is halved first (Rivara's longest-edge propagation path). Edges are totally ordered by length, so the path
// is finite, and the result does not depend on the order in which equals are taken: a symmetric mesh stays
// symmetric.
#pragma once

#include <functional>

#include "acus/mesh/tet_mesh.h"

namespace acus::mesh {

// The longest edge wanted of a tetrahedron at a point, m; positive.
using SizeField = std::function<double(const Vec3&)>;

// `mesh` refined until no tetrahedron has an edge longer than `size` at any of its corners, the ones furthest
// from it first, or until the mesh has 98 % of `most_tets`, which it never exceeds. Edges are never cut below
// 1e-6 of the mesh's extent. Nodes keep their indices, new ones follow; regions, total volume and surface
// stay as they were. Expects a mesh of positive, conforming tetrahedra.
TetMesh refined(TetMesh mesh, const SizeField& size, int most_tets);

// `refined` towards the straight line from `from` to `to` [m]: edges of `near` [m] on it, growing by
// `grading` per unit of distance away from it (0.3 is gentle, 1 is steep).
TetMesh refined_along_path(TetMesh mesh, const Vec3& from, const Vec3& to, double near, double grading,
                           int most_tets);

// Distance of `point` from the straight line between `from` and `to`, ends included. m
double distance_to_segment(const Vec3& point, const Vec3& from, const Vec3& to);

}  // namespace acus::mesh
