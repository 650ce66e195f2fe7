// Warped stiffness (paper Eq. 5; Mueller and Gross 2004): every element's rotation, elastic force and energy.
//
// With R the rotation of F = sum_i x_i g_i^T, the strain is e = sym(R^T F) - I, the stress 2 mu e + lambda
// tr(e) I, and the force on corner i is f_i = -V R sigma g_i, which is Eq. 5's -R K (R^-1 x - x0) written
// without the 12x12 matrix. With the polar R it is the exact gradient of the energy V (mu e:e + lambda/2
// tr(e)^2). For nodal_pressure, lambda is -2 mu / 3 and node a adds kappa_a V_a theta_a^2 / 2 with its mean
// dilation theta_a = sum over its elements of (V / 4) tr(e) / V_a. A Maxwell branch (relaxation.h) adds its
// stress.
#pragma once

#include <span>
#include <vector>

#include "acus/base/vec.h"
#include "acus/numeric/node_vector.h"
#include "acus/tissue/tissue_model.h"

namespace acus::tissue {

// Rotations and forces exactly, or in single precision: strains are then rounded to 1e-7 of the
// displacement's gradient and of the turn.
enum class ForcePrecision { exact, single };

// Where the elements are, in the precision that was chosen, and the working memory of its kernels.
template <class Real>
struct RotatedElements {
  std::vector<Real> gradient;            // [groups][9] 1/m: q_i = R g_i of corners 1 to 3
  std::vector<Real> turn;                // [groups][4] R as a quaternion (tracked_rotation.h)
  numeric::NodeVectorOf<Real> pressure;  // [nodes] Pa, the fourth number; empty for linear
  numeric::NodeVectorOf<Real> parts;     // [streams][nodes] N, what they ask of the nodes, zero in between
};

struct Corotation {
  RotatedElements<double> exact;      // empty where the precision is single
  RotatedElements<float> single;      // where it is not, no more of it than the gradients
  numeric::NodeVector displacement;   // [nodes] m
  std::vector<double> dilation;       // [nodes] theta_a; stays empty for linear
  numeric::NodeVector elastic_force;  // [nodes] N, of the tissue on its nodes
  double energy = 0.0;                // J, with that of the branches' springs
  double relaxed = 0.0;               // J, spent by the branches' dashpots in the step that ends here
  bool finite = true;                 // false as soon as a position is not a number
  int safe_rotations = 0;             // elements and fillers that needed the slow, safe rotation

  bool is_single() const { return exact.gradient.empty(); }
};

Corotation build_corotation(const TissueModel& model, ForcePrecision precision = ForcePrecision::exact);

// Evaluates all of it, but for the branches, at `positions` (one per node, m).  Rotations go on from those
// before, of whatever configuration. Inverted, flat and collapsed elements are allowed.
void corotate_into(Corotation& out, const TissueModel& model, std::span<const Vec3> positions,
                   const Team& team = one_thread);
// The same at the end of a step, over which `branch` is taken. To `elastic_force` it adds what would be left
// of its force at the end of the next one if nothing moved; the system matrix has the rest.
void corotate_into(Corotation& out, MaxwellBranch& branch, const TissueModel& model,
                   std::span<const Vec3> positions, const Team& team = one_thread);

}  // namespace acus::tissue
