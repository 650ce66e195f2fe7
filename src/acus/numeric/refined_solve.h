// Solves in single precision that end in double: iterative refinement (Wilkinson 1963; Buttari et al. 2007).
//
// Conjugate gradients spend their time moving numbers, and floats are half of them. The residual is formed in
// double; single precision finds a correction that brings it down; and so on until the residual formed in
// double is small enough. The answer is as good as one computed in double throughout.
#pragma once

#include <algorithm>
#include <cmath>

#include "acus/numeric/conjugate_gradients.h"

namespace acus::numeric {

struct RefinedScratch {
  NodeVector residual, product;
  NodeVectorOf<float> load, correction;
  CgScratch<float> single;
  explicit RefinedScratch(int nodes = 0)
      : residual(static_cast<std::size_t>(node_stride) * nodes),
        product(residual),
        load(residual.size()),
        correction(load),
        single(nodes) {}
};

// Solves A x = b from the start value in x until |b - A x| <= `target` or `max_iterations` in all.
// multiply(y, p) writes y = A p and takes vectors of double and of float; precondition(z, r) is as in
// `solve_into`, in float. `residual_norm` of the outcome is computed, or follows by recursion from one that
// was within a factor of `trusted_fall`.
template <class Multiply, class Precondition>
CgOutcome solve_refined_into(NodeVector& x, const NodeVector& b, double target, int max_iterations,
                             RefinedScratch& s, const Multiply& multiply, const Precondition& precondition) {
  constexpr double largest_fall = 1e-5;  // of the residual in one round: beyond it floats drown in rounding
  constexpr double trusted_fall = 1e-3;  // down to here rounding stays within the margin: no check
  constexpr double margin = 0.95;        // for the rounding of a round
  CgOutcome outcome;
  while (true) {
    multiply(s.product, x);
    s.residual = b;
    add_scaled_into(s.residual, -1.0, s.product);
    const double norm = std::sqrt(dot(s.residual, s.residual));
    outcome.residual_norm = norm;
    if (norm <= target || outcome.iterations >= max_iterations) return outcome;
    outcome.broke_down = !std::isfinite(norm);
    if (outcome.broke_down) return outcome;

    // To a norm of 1, so that nothing falls below the smallest float.
    scale_into(s.load, 1.0 / norm, s.residual);
    std::fill(s.correction.begin(), s.correction.end(), 0.0F);
    const double fall = std::max(margin * target / norm, largest_fall);
    const CgOutcome round = solve_into(s.correction, s.load, fall, max_iterations - outcome.iterations,
                                       s.single, multiply, precondition);
    outcome.iterations += round.iterations;
    outcome.broke_down = round.broke_down;
    add_scaled_into(x, norm, s.correction);
    outcome.residual_norm = norm * round.residual_norm;
    if (outcome.broke_down || (fall >= trusted_fall && outcome.residual_norm <= target)) return outcome;
  }
}

}  // namespace acus::numeric
