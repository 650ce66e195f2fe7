// Stress relaxation: beside the elastic tissue stands a spring in series with a dashpot, a Maxwell branch,
// which resists changes of shape only, so that the tissue is a standard linear solid in shear and elastic in
// volume. With G the long-term shear modulus, m the branch's modulus over it, and q the strain of its spring,
//   stress = elastic stress + 2 G m q,   dq/dt = de/dt - q / tau,
// where e is the deviator of the strain in the element's rotated frame (corotation.h), so that q needs no
// turning. For a strain that goes straight through a step of x = h / tau the solution is exact (Taylor,
// Pister and Goudreau, Int. J. Num. Meth. Eng. 2, 1970; Simo and Hughes, Computational Inelasticity, ch. 10):
//   q1 = a q0 + b (e1 - e0),   a = exp(-x),   b = (1 - a) / x,
// whatever the step. To the system matrix the branch is a shear modulus of G m b more, and nothing else; the
// force at a step's beginning is that of a q0, with what the rotation adds (branch_lanes.h, skew_stress). The
// dashpot spends exactly
//   integral of 2 G m |q|^2 / tau = 2 G m (c |q0 + s (e1 - e0)|^2 + r |e1 - e0|^2)   J/m^3 in a step,
//   c = x b (1 + a) / 2,   s = b / (1 + a),   r >= 0: a sum of squares, which cannot shrink.
#pragma once

#include <vector>

namespace acus::tissue {

// The share is of the stiffness in shear that a sudden load meets, and is gone after a while: what a force
// that is held relaxes by, and what finite-element programs call g of a Prony term (Abaqus' g_1, with its
// moduli "long term").
struct Relaxation {
  double share = 0.0;  // in [0, 1)
  double time = 1.0;   // s, tau
};

struct RelaxationStep {
  double modulus = 0.0;  // m = share / (1 - share)
  double kept = 0.0;     // a
  double taken = 0.0;    // b
  double spent = 0.0;    // c
  double lead = 0.0;     // s
  double rest = 0.0;     // r

  bool relaxes() const { return modulus > 0.0; }
  double stiffening() const { return modulus * taken; }  // of the shear modulus, for a step
};
RelaxationStep relaxation_step(const Relaxation& relaxation, double h);

// Six numbers of each element, xx yy zz xy xz yz. Both stay empty where nothing relaxes.
inline constexpr int strain_numbers = 6;
struct MaxwellBranch {
  std::vector<double> spring;  // [groups of floats][6] q
  std::vector<double> strain;  // [groups of floats][6] e, at the end of the last step
};

}  // namespace acus::tissue
