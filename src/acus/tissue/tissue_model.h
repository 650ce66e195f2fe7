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
#include "acus/tissue/relaxation.h"
#include "acus/tissue/streams.h"

namespace acus::tissue {

// Elements stand in groups of `lanes` side by side, as many as doubles fill 64 bytes; their count is padded
// to a multiple of `padding`, as many as floats do.
inline constexpr int lanes = 8;
inline constexpr int padding = 16;

// Where number `k` of `numbers` of an element stands in an array [groups][numbers][lanes].
inline constexpr std::size_t lane_place(int tet, int k, int numbers) {
  return (static_cast<std::size_t>(tet / lanes) * numbers + k) * lanes + tet % lanes;
}

using Offsets = std::array<std::uint32_t, 4>;  // unsigned: an address is then one addition

struct TissueModel {
  ElementKind kind = ElementKind::nodal_pressure;
  int nodes = 0;
  int free_nodes = 0;  // nodes 0 .. free_nodes - 1 move; the rest are held
  int tets = 0;
  RelaxationStep relaxation;

  Streams streams;
  std::vector<mesh::Tet> corners;    // [groups][lanes]
  std::vector<Offsets> offsets;      // [groups][lanes] where the corners stand in a node vector
  std::vector<double> gradient;      // [groups][9][lanes] 1/m: g_1, g_2, g_3 of Shape; g_0 = -(sum)
  std::vector<double> volume;        // [groups][lanes] m^3; 0 in the padding
  std::vector<double> shear;         // [groups][lanes] Pa, mu
  std::vector<double> local_lambda;  // [groups][lanes] Pa, acts on the element's own dilation
  // What the system matrix shows of the two: more by what a Maxwell branch adds to a step (relaxation.h).
  std::vector<double> step_shear;         // [groups][lanes] Pa
  std::vector<double> step_lambda;        // [groups][lanes] Pa
  std::vector<double> node_mass;          // [nodes] kg, lumped
  std::vector<double> node_volume;        // [nodes] m^3, a quarter of each tetrahedron
  std::vector<double> node_bulk_modulus;  // [nodes] Pa, volume-weighted mean; empty for linear
};

// `materials` has one entry per tetrahedron; `mesh` numbers its free nodes first. Errors: element and reason.
Result<TissueModel> build_tissue_model(const mesh::TetMesh& mesh, std::span<const Material> materials,
                                       ElementKind kind, int free_nodes,
                                       const RelaxationStep& relaxation = {});

MaxwellBranch build_branch(const TissueModel& model);

}  // namespace acus::tissue
