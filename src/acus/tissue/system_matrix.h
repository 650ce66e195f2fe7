// Element stiffness in the rotated frame together with the mass (paper Eq. 4-7), as an operator.
//
// Eq. 4's K_e = V B^T E B of an isotropic material, turned as in Eq. 5, has on the rotated gradients q_i = R
// g_i the 3x3 blocks K'_ij = V (lambda q_i q_j^T + mu q_j q_i^T + mu (q_i . q_j) I). With the gradient G =
// sum_j x_j q_j^T of a nodal field, Eq. 6's sum over the elements is therefore
//   (K' x)_i = sum over elements of V (lambda tr(G) I + mu (G + G^T)) q_i,
// which is applied element by element: twelve numbers of an element serve where sixteen blocks would be
// stored and fetched. Nodal pressure adds sum over nodes of kappa_a V_a b_a b_a^T with
// b_a,j = sum over shared elements of V / (4 V_a) q_j; so b_a . x is the node's mean of tr(G).
#pragma once

#include <vector>

#include "acus/tissue/corotation.h"
#include "acus/tissue/tissue_model.h"

namespace acus::tissue {

// A = mass_factor M + stiffness_factor K', over the free nodes. It is applied straight from
// the rotated gradients, in double only where these are.
struct SystemMatrix {
  double mass_factor = 1.0;
  double stiffness_factor = 0.0;

  std::vector<float> moduli;           // [groups][element_moduli] J, as of ElementsAtRest, with the factor
  std::vector<float> mass;             // [free nodes] kg, with the factor
  std::vector<float> pressure_weight;  // [nodes] kappa_a / V_a with the factor; empty for linear

  // Working memory of a product, over all nodes: x with the nodal pressure beside it; for each stream, its
  // part of K' x with the sum of V tr(G) / 4, zero in between.
  mutable numeric::NodeVector field, reaction;
  mutable numeric::NodeVectorOf<float> field_single, reaction_single;
};

SystemMatrix build_system_matrix(const TissueModel& model);

void set_factors(SystemMatrix& out, const TissueModel& model, double mass_factor, double stiffness_factor);

// y = A x with the factors of `a` and K' at the configuration of `corotation`, whose precision must be exact.
void multiply_into(numeric::NodeVector& y, const TissueModel& model, const Corotation& corotation,
                   const SystemMatrix& a, const numeric::NodeVector& x, const Team& team = one_thread);
// The same in single precision, whatever that of `corotation`.
void multiply_into(numeric::NodeVectorOf<float>& y, const TissueModel& model, const Corotation& corotation,
                   const SystemMatrix& a, const numeric::NodeVectorOf<float>& x,
                   const Team& team = one_thread);

}  // namespace acus::tissue
