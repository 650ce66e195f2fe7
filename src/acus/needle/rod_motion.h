// The rod's equation of motion M a = f(x) + f_out by implicit Euler, to be solved by Newton's method:
//   M (v1 - v0) = h f(x0 + h v1) + h f_out,   x1 = x0 + h v1,
// with v1 = v + dv at an iterate v:   (M + h^2 K) dv = M (v0 - v) + h (f(x) + f_out).
// Whoever holds the rod adds what it does to both sides between `linearise` and the factorisation. A hub that
// is led exactly has node 0 where it is in the first iterate, and `hold_hub` keeps it there; the residual
// left on it is the hub's impulse.
#pragma once

#include "acus/needle/rod_forces.h"

namespace acus::needle {

struct RodMotion {
  RodMatrix matrix;                 // M + h^2 K, then its factors
  std::vector<double> rate_before;  // v0, [unknowns]
  std::vector<double> force;        // f(x), [unknowns] N and N m
  std::vector<double> residual;     // right-hand side, N s and N m s; [unknowns]
  std::vector<double> change;       // [unknowns]
  RodEnergy energy;                 // at the iterate
};
RodMotion build_rod_motion(const Rod& rod);

// kg or kg m^2 of every unknown.
double inertia(const Rod& rod, int unknown);
// v . M v, twice the kinetic energy.
double inertia_product(const Rod& rod, const std::vector<double>& rate);

// A first iterate: the hub at the end of the step, all nodes with the rates they had and the hub's change of
// rate, so that nothing is squeezed.
void begin_step(RodMotion& motion, const Rod& rod, RodState& state, const Pose& hub, double h);

// Forces, energy and right-hand side at the iterate, without anything from outside.
void load(RodMotion& motion, const Rod& rod, const RodState& state, const Pose& hub, const Pose& tip,
          double h);
// The same, and the matrix. `compression` as in rod_forces.h.
void linearise(RodMotion& motion, const Rod& rod, const RodState& state, const Pose& hub, const Pose& tip,
               double h, double compression);

// No change of node 0.
void hold_hub(RodMotion& motion);

// The iterate moves on by motion.change.
void apply_change(RodMotion& motion, const Rod& rod, RodState& state, double h);

}  // namespace acus::needle
