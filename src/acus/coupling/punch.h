// What a mesh cannot sink by under the disc that spreads a tip load.
//
// A load on a disc of radius a dents the tissue around it: the elastic energy per volume falls like 1 / rho^4
// with rho^2 = a^2 + r^2, r the distance from the centre (Boussinesq's displacement falls like 1 / r). An
// element of edge h cannot follow within its own size and holds a share rho^2 / (rho^2 + h^2) of what it
// should. A sink is twice the energy over the force, so the share of all energy that is missing is the share
// of the sink that is, and that compliance belongs in series with the mesh's. It falls like h^2.
#pragma once

#include "acus/mesh/locator.h"

namespace acus::coupling {

// m, of a tetrahedron: side of the cube that six like it fill (Kuhn's), by the mean square of its edges.
double cube_edge(const mesh::Tet& tet, std::span<const Vec3> nodes);

// Of the half-space's sink, from 0 to 1: what the mesh has too little of under a disc at its surface.
// Symbols: a = radius [m], h_0 the mean cube edge under the disc, V the elements' volumes,
//   1 - 2 a / (a + sqrt(a^2 + h_0^2)) + 2 a / pi^2 sum of V (s(h) - s(h_0)), s(h) = h^2 / (rho^4 (rho^2 +
//   h^2)),
// the first two terms for elements of h_0 everywhere in a half-space, the sum for how they differ from that.
double missing_share(const mesh::TetMesh& mesh, const mesh::Locator& locator, const Vec3& centre,
                     const Vec3& axis, double radius, int rings);

}  // namespace acus::coupling
