// Preconditioned conjugate gradients (Hestenes and Stiefel 1952) for symmetric positive definite systems,
// with the residual smoothed (Schoenauer 1987; Weiss 1994).
//
// Conjugate gradients make the energy of the error least, and on the way the residual may rise to many times
// its start, most of all from a start that is nearly right. The residual is what a solve ends by; so of each
// iterate and the best so far the mean is kept whose residual is least.
#pragma once

#include <cmath>

#include "acus/numeric/node_vector.h"

namespace acus::numeric {

template <class Real>
struct SolveScratch {
  NodeVectorOf<Real> residual;                   // the smoothed one
  NodeVectorOf<Real> iterate, iterate_residual;  // of conjugate gradients
  NodeVectorOf<Real> direction, product, preconditioned;
  explicit SolveScratch(int nodes = 0) {
    for (NodeVectorOf<Real>* v :
         {&residual, &iterate, &iterate_residual, &direction, &product, &preconditioned})
      v->assign(static_cast<std::size_t>(node_stride) * nodes, Real{});
  }
};

struct SolveOutcome {
  int iterations = 0;
  double residual_norm = 0.0;  // by recursion
  bool broke_down = false;     // a direction with p^T A p <= 0, or a number that is not finite
};

// Improves x until |b - A x| <= `target` or `max_iterations`; b - A x stands in `s.residual` and ends there.
// multiply(y, p) writes y = A p; precondition(z, r) writes z ~ A^-1 r with a symmetric positive definite
// operator.
template <class Real, class Multiply, class Precondition>
SolveOutcome improve_into(NodeVectorOf<Real>& x, double target, int max_iterations, SolveScratch<Real>& s,
                          const Multiply& multiply, const Precondition& precondition,
                          const Team& team = one_thread) {
  SolveOutcome outcome;
  const double target_squared = target * target;
  double least = dot(s.residual, s.residual, team);
  double rz_before = 0.0;
  copy_into(s.iterate, x, team);
  copy_into(s.iterate_residual, s.residual, team);
  while (least > target_squared && outcome.iterations < max_iterations) {
    precondition(s.preconditioned, s.iterate_residual);
    const double rz = dot(s.iterate_residual, s.preconditioned, team);
    if (outcome.iterations == 0)
      copy_into(s.direction, s.preconditioned, team);
    else
      scale_and_add_into(s.direction, rz / rz_before, s.preconditioned, team);
    rz_before = rz;
    multiply(s.product, s.direction);
    const double curvature = dot(s.direction, s.product, team);
    if (!(curvature > 0.0)) break;
    const double rr =
        advance_into(s.iterate, s.iterate_residual, rz / curvature, s.direction, s.product, team);
    ++outcome.iterations;
    // The share of the iterate at which the mean residual is least.
    const double mixed = dot(s.residual, s.iterate_residual, team);
    const double apart = rr - 2.0 * mixed + least;  // square of the distance of the two residuals
    if (apart > 0.0)
      least = approach_into(x, s.residual, (least - mixed) / apart, s.iterate, s.iterate_residual, team);
  }
  outcome.residual_norm = std::sqrt(least);
  outcome.broke_down = !(least <= target_squared) && outcome.iterations < max_iterations;
  return outcome;
}

// Solves A x = b from the start value in x.
template <class Real, class Multiply, class Precondition>
SolveOutcome solve_into(NodeVectorOf<Real>& x, const NodeVectorOf<Real>& b, double target, int max_iterations,
                        SolveScratch<Real>& s, const Multiply& multiply, const Precondition& precondition,
                        const Team& team = one_thread) {
  multiply(s.product, x);
  copy_into(s.residual, b, team);
  add_scaled_into(s.residual, -1.0, s.product, team);
  return improve_into(x, target, max_iterations, s, multiply, precondition, team);
}

}  // namespace acus::numeric
