// TissueModel: what stays constant while the tissue moves, laid out for the step's kernels.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "acus/base/result.h"
#include "acus/mesh/tet_mesh.h"
#include "acus/tissue/element_kind.h"
#include "acus/tissue/material.h"
#include "acus/tissue/pairs.h"
#include "acus/tissue/relaxation.h"
#include "acus/tissue/streams.h"

namespace acus::tissue {

// Numbers of elements stand in groups of `lanes` side by side, as many as doubles fill 64 bytes.
inline constexpr int lanes = 8;

// Where number `k` of `numbers` of an element stands in an array [groups][numbers][lanes].
inline constexpr std::size_t lane_place(int element, int k, int numbers) {
  return (static_cast<std::size_t>(element / lanes) * numbers + k) * lanes + element % lanes;
}

// Of the five nodes of a pair, those of the shared face first. Unsigned: an address is then one addition.
inline constexpr int pair_nodes = 5;
using Offsets = std::array<std::uint32_t, pair_nodes>;

struct TissueModel {
  ElementKind kind = ElementKind::nodal_pressure;
  int nodes = 0;
  int free_nodes = 0;  // nodes 0 .. free_nodes - 1 move; the rest are held
  int tets = 0;        // of the mesh
  RelaxationStep relaxation;

  Streams streams;
  std::vector<int> element;        // [tets] its element, of those below (pairs.h)
  std::vector<mesh::Tet> corners;  // [groups][lanes]
  std::vector<Offsets> offsets;    // [pairs] where their nodes stand in a node vector
  std::vector<double> gradient;    // [groups][9][lanes] 1/m: g_1, g_2, g_3 of Shape; g_0 = -(sum)
  std::vector<double> volume;      // [groups][lanes] m^3; 0 of what only fills
  // [groups][lanes] m^3, V / 4 where the nodes have pressures; 0 for linear
  std::vector<double> quarter_volume;
  std::vector<float> single_quarter_volume;  // [groups of 16][16] the same
  std::vector<double> shear;                 // [groups][lanes] Pa, mu
  std::vector<double> local_lambda;          // [groups][lanes] Pa, acts on the element's own dilation
  // What the system matrix shows of the two: more by what a Maxwell branch adds to a step (relaxation.h).
  std::vector<double> step_shear;         // [groups][lanes] Pa
  std::vector<double> step_lambda;        // [groups][lanes] Pa
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
