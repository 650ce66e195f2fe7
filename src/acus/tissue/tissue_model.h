// TissueModel: what stays constant while the tissue moves, laid out for the step's kernels.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "acus/base/result.h"
#include "acus/base/vec.h"
#include "acus/mesh/tet_mesh.h"
#include "acus/numeric/simd.h"
#include "acus/tissue/element_kind.h"
#include "acus/tissue/material.h"
#include "acus/tissue/pairs.h"
#include "acus/tissue/relaxation.h"
#include "acus/tissue/streams.h"

namespace acus::tissue {

// Numbers of elements stand in groups side by side, as many as fill 64 bytes: where number `k` of `numbers`
// of an element stands in an array [groups][numbers][that many].
template <class Real>
constexpr std::size_t place_of(std::size_t element, int k, int numbers) {
  constexpr std::size_t group = numeric::lane_count<Real>;
  return (element / group * static_cast<std::size_t>(numbers) + static_cast<std::size_t>(k)) * group +
         element % group;
}

// Of the five nodes of a pair, those of the shared face first. Unsigned: an address is then one addition.
inline constexpr int pair_nodes = 5;
using Offsets = std::array<std::uint32_t, pair_nodes>;

// What a kernel must know of the elements at rest, in its precision.
inline constexpr int element_moduli = 2;
template <class Real>
struct ElementsAtRest {
  std::vector<Real> gradient;        // [groups][9] 1/m: g_1, g_2, g_3 of Shape; g_0 = -(sum)
  std::vector<Real> moduli;          // [groups][2] J: V mu, and V lambda of the element's own dilation
  std::vector<Real> quarter_volume;  // [groups] m^3, V / 4 where the nodes have pressures; 0 for linear
};

struct TissueModel {
  ElementKind kind = ElementKind::nodal_pressure;
  int nodes = 0;
  int free_nodes = 0;  // nodes 0 .. free_nodes - 1 move; the rest are held
  int tets = 0;        // of the mesh
  RelaxationStep relaxation;

  Streams streams;
  std::vector<int> element;          // [tets] its element, of those below (pairs.h)
  std::vector<mesh::Tet> corners;    // [elements]
  std::vector<Offsets> offsets;      // [pairs] where their nodes stand in a node vector
  std::vector<double> volume;        // [elements] m^3; 0 of what only fills
  std::vector<double> shear;         // [elements] Pa, mu
  std::vector<double> local_lambda;  // [elements] Pa, acts on the element's own dilation
  // What the system matrix shows of the two: more by what a Maxwell branch adds to a step (relaxation.h).
  std::vector<double> step_shear;   // [elements] Pa
  std::vector<double> step_lambda;  // [elements] Pa
  ElementsAtRest<double> exact;
  ElementsAtRest<float> single;

  std::vector<Vec3> rest;                 // [nodes] m
  std::vector<double> node_mass;          // [nodes] kg, lumped
  std::vector<double> node_volume;        // [nodes] m^3, a quarter of each tetrahedron
  std::vector<double> node_bulk_modulus;  // [nodes] Pa, volume-weighted mean; empty for linear
};

// `materials` has one entry per tetrahedron; `mesh` numbers its free nodes first. Errors: tetrahedron and
// reason.
Result<TissueModel> build_tissue_model(const mesh::TetMesh& mesh, std::span<const Material> materials,
                                       ElementKind kind, int free_nodes,
                                       const RelaxationStep& relaxation = {});

MaxwellBranch build_branch(const TissueModel& model);

}  // namespace acus::tissue
