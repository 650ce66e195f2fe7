// Element stiffness in the rotated frame, assembled with the mass (paper Eq. 4-7).
//
// Eq. 4's K_e = V B^T E B of an isotropic material has the 3x3 block
//   K_ij = V (lambda g_i g_j^T + mu g_j g_i^T + mu (g_i . g_j) I),
// so Eq. 5's K' = R K R^T has the same block on the rotated gradients q_i = R g_i. Nodal pressure adds
// sum over nodes of kappa_a V_a b_a b_a^T with b_a,j = sum over shared elements of V / (4 V_a) q_j,
// which is applied without being formed: it would couple every node to its neighbours' neighbours.
#pragma once

#include <vector>

#include "acus/tissue/corotation.h"
#include "acus/tissue/tissue_model.h"

namespace acus::tissue {

// A = mass_factor M + stiffness_factor K', over the free nodes.
struct SystemMatrix {
  std::vector<double> block;             // [entries of the free rows][block_stride]
  std::vector<double> divergence;        // [pattern entries][node_stride] 1/m: b_a,j; empty for linear
  std::vector<double> pressure_weight;   // [nodes] stiffness_factor kappa_a V_a; empty for linear
  std::vector<double> inverse_diagonal;  // [free nodes][block_stride] inverse of the 3x3 diagonal blocks
};

SystemMatrix build_system_matrix(const TissueModel& model);

// K' at the configuration of `corotation`. Returns false when a diagonal block is not positive definite.
bool assemble_into(SystemMatrix& out, const TissueModel& model, const Corotation& corotation,
                   double mass_factor, double stiffness_factor);

// y = A x
void multiply_into(numeric::NodeVector& y, const TissueModel& model, const SystemMatrix& a,
                   const numeric::NodeVector& x);

}  // namespace acus::tissue
