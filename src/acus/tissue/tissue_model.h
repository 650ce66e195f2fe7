// TissueModel: what stays constant while the tissue moves, laid out for the step's kernels.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "acus/base/result.h"
#include "acus/mesh/tet_mesh.h"
#include "acus/numeric/block_matrix.h"
#include "acus/tissue/element_kind.h"
#include "acus/tissue/material.h"

namespace acus::tissue {

inline constexpr int lanes = 8;  // elements handled side by side by a kernel

struct TissueModel {
  ElementKind kind = ElementKind::nodal_pressure;
  int nodes = 0;
  int free_nodes = 0;  // nodes 0 .. free_nodes - 1 move; the rest are held
  int tets = 0;
  int batches = 0;  // ceil(tets / lanes)

  std::vector<mesh::Tet> corners;         // [tets]
  std::vector<double> gradient;           // [batches][9][lanes] 1/m: g_1, g_2, g_3 of Shape; g_0 = -(sum)
  std::vector<double> volume;             // [batches][lanes] m^3; 0 in padding lanes
  std::vector<double> shear;              // [batches][lanes] Pa, mu
  std::vector<double> local_lambda;       // [batches][lanes] Pa, acts on the element's own dilation
  std::vector<double> node_mass;          // [nodes] kg, lumped
  std::vector<double> node_volume;        // [nodes] m^3, a quarter of each tetrahedron
  std::vector<double> node_bulk_modulus;  // [nodes] Pa, volume-weighted mean; empty for linear

  numeric::BlockPattern pattern;  // rows: all nodes; columns: free nodes
  std::vector<std::array<int, 16>>
      slot;  // [tets] entry of corner pair (i, j) at 4 i + j; -1 where not stored
};

// `materials` has one entry per tetrahedron; `mesh` numbers its free nodes first. Errors: element and reason.
Result<TissueModel> build_tissue_model(const mesh::TetMesh& mesh, std::span<const Material> materials,
                                       ElementKind kind, int free_nodes);

}  // namespace acus::tissue
