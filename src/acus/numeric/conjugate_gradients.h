// Preconditioned conjugate gradients (Hestenes and Stiefel 1952) for symmetric positive definite systems.
#pragma once

#include <cmath>

#include "acus/numeric/node_vector.h"

namespace acus::numeric {

template <class Real>
struct CgScratch {
  NodeVectorOf<Real> residual, direction, product, preconditioned;
  explicit CgScratch(int nodes = 0) {
    for (NodeVectorOf<Real>* v : {&residual, &direction, &product, &preconditioned})
      v->assign(static_cast<std::size_t>(node_stride) * nodes, Real{});
  }
};

struct CgOutcome {
  int iterations = 0;
  double residual_norm = 0.0;  // by recursion
  bool broke_down = false;     // a direction with p^T A p <= 0, or a number that is not finite
};

// Solves A x = b from the start value in x until |b - A x| <= `target` or `max_iterations`.
// multiply(y, p) writes y = A p; precondition(z, r) writes z ~ A^-1 r with a symmetric positive definite
// operator.
template <class Real, class Multiply, class Precondition>
CgOutcome solve_into(NodeVectorOf<Real>& x, const NodeVectorOf<Real>& b, double target, int max_iterations,
                     CgScratch<Real>& s, const Multiply& multiply, const Precondition& precondition) {
  CgOutcome outcome;
  multiply(s.product, x);
  s.residual = b;
  add_scaled_into(s.residual, -1.0, s.product);
  double rr = dot(s.residual, s.residual);
  double rz_before = 0.0;
  const double target_squared = target * target;
  while (rr > target_squared && outcome.iterations < max_iterations) {
    precondition(s.preconditioned, s.residual);
    const double rz = dot(s.residual, s.preconditioned);
    if (outcome.iterations == 0)
      s.direction = s.preconditioned;
    else
      scale_and_add_into(s.direction, rz / rz_before, s.preconditioned);
    rz_before = rz;
    multiply(s.product, s.direction);
    const double curvature = dot(s.direction, s.product);
    if (!(curvature > 0.0)) break;
    const double step = rz / curvature;
    rr = advance_into(x, s.residual, step, s.direction, s.product);
    ++outcome.iterations;
  }
  outcome.residual_norm = std::sqrt(rr);
  outcome.broke_down = !(rr <= target_squared) && outcome.iterations < max_iterations;
  return outcome;
}

}  // namespace acus::numeric
