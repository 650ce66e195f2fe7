// Solves in single precision that end in double: iterative refinement (Wilkinson 1963; Buttari et al. 2007).
//
// An iteration spends its time moving numbers, and floats are half of them. From a residual in double, single
// precision finds a correction that brings it down; and so on until the residual in double is small enough.
// The answer is as good as one computed in double throughout.
#pragma once

#include <algorithm>
#include <cmath>

#include "acus/numeric/conjugate_gradients.h"

namespace acus::numeric {

struct RefinedScratch {
  NodeVector step, product;
  NodeVectorOf<float> correction;
  SolveScratch<float> single;
  explicit RefinedScratch(int nodes = 0)
      : step(static_cast<std::size_t>(node_stride) * nodes),
        product(step),
        correction(step.size()),
        single(nodes) {}
};

// Improves x until the norm of its residual b - A x is at most `target` or after `max_iterations` in all;
// `residual` is that of the start value, and in the end that of x. multiply(y, p) writes y = A p and takes
// vectors of double and of float; precondition(z, r) is as in `improve_into`, in float. What a round leaves
// is computed or, with `trust_recursion` and within a factor of `trusted_fall`, follows by recursion, with an
// error of 1e-7 of what the round began with and some more.
template <class Multiply, class Precondition>
SolveOutcome improve_refined_into(NodeVector& x, NodeVector& residual, double target, int max_iterations,
                                  bool trust_recursion, RefinedScratch& s, const Multiply& multiply,
                                  const Precondition& precondition, const Team& team = one_thread) {
  constexpr double largest_fall = 1e-5;  // of the residual in one round: beyond it floats drown in rounding
  constexpr double trusted_fall = 1e-3;  // down to here rounding stays within the margin: no check
  constexpr double margin = 0.95;        // for the rounding of a round
  SolveOutcome outcome;
  while (true) {
    const double norm = std::sqrt(dot(residual, residual, team));
    outcome.residual_norm = norm;
    outcome.broke_down = outcome.broke_down || !std::isfinite(norm);
    if (norm <= target || outcome.iterations >= max_iterations || outcome.broke_down) return outcome;

    // To a norm of 1, so that nothing falls below the smallest float.
    scale_into(s.single.residual, 1.0 / norm, residual, team);
    std::fill(s.correction.begin(), s.correction.end(), 0.0F);
    const double fall = std::max(margin * target / norm, largest_fall);
    const SolveOutcome round = improve_into(s.correction, fall, max_iterations - outcome.iterations, s.single,
                                            multiply, precondition, team);
    outcome.iterations += round.iterations;
    outcome.broke_down = round.broke_down && round.residual_norm > fall;
    add_scaled_into(x, norm, s.correction, team);
    if (trust_recursion && fall >= trusted_fall) {
      scale_into(residual, norm, s.single.residual, team);
    } else {
      scale_into(s.step, norm, s.correction, team);
      multiply(s.product, s.step);
      add_scaled_into(residual, -1.0, s.product, team);
    }
  }
}

// The same in double throughout, but for `precondition`, which stays in float.
template <class Multiply, class Precondition>
SolveOutcome improve_in_double_into(NodeVector& x, NodeVector& residual, double target, int max_iterations,
                                    SolveScratch<double>& s, SolveScratch<float>& single,
                                    const Multiply& multiply, const Precondition& precondition,
                                    const Team& team = one_thread) {
  copy_into(s.residual, residual, team);
  const SolveOutcome outcome = improve_into(
      x, target, max_iterations, s, multiply,
      [&](NodeVector& z, const NodeVector& r) {
        const double norm = std::sqrt(dot(r, r, team));  // so that nothing falls below the smallest float
        scale_into(single.residual, norm > 0.0 ? 1.0 / norm : 1.0, r, team);
        precondition(single.preconditioned, single.residual);
        scale_into(z, norm, single.preconditioned, team);
      },
      team);
  copy_into(residual, s.residual, team);
  return outcome;
}

}  // namespace acus::numeric
