// What a step does with the tissue, whatever the needle is made of.
#pragma once

#include <functional>

#include "acus/sim/scratch.h"
#include "acus/sim/state.h"
#include "acus/sim/step_probe.h"

namespace acus {

// What the end of a step must know of its beginning.
struct TissueBefore {
  double energy = 0.0;        // J
  double elastic_work = 0.0;  // J, of the forces at the beginning over the step's displacement
  double matrix_product =
      0.0;  // kg m^2/s^2, v . A v with the matrix at the beginning and the step's velocity
};

// Whether single precision will do for all that a step computes afresh. In whole insertions it lost of the
// load 1e-8 times the ratio of bulk and shear modulus: 3e-7 at Poisson's ratio 0.48, 5e-6 at 0.499, 3e-5 at
// 0.4999; the tolerance must be twice that.
bool single_precision_will_do(const Model& model);

// y = A x with the tissue's own matrix: of doubles as exactly as that allows, with working memory of the
// solver's inner iterations; of floats singly.
void multiply_tissue(numeric::NodeVector& y, const Model& model, Scratch& scratch,
                     const numeric::NodeVector& x);
void multiply_tissue(numeric::NodeVectorOf<float>& y, const Model& model, Scratch& scratch,
                     const numeric::NodeVectorOf<float>& x);

// The momentum at the present positions, without the needle.
void form_momentum(const Model& model, const State& state, Scratch& scratch);

// The share of a change that may be expected again in the next step: as much as came again in the last ones,
// `again` the product of the last change with the one before and `all` that one's square. A smooth motion
// goes on all the way; what solves leave over does not come again, and would be doubled by going on.
double persistence_after(double before, double again, double all);

// A start for the solve near its answer, from the velocities before, and its imbalance. The momentum is
// complete.
void begin_tissue(const Model& model, State& state, Scratch& scratch);

// N s, what a solve may leave: the model's tolerance of its right-hand side and of the `load` [N] on the
// tissue. In a slow insertion the first is what hardly moves, a hundredth of the load and less.
double residual_target(const Model& model, const Scratch& scratch, const numeric::NodeVector& right_hand_side,
                       double load);

// Jacobi by the blocks of the nodes and a coarse grid, for the matrix of the tissue alone.
inline auto preconditioner(const Model& m, Scratch& w) {
  using Single = numeric::NodeVectorOf<float>;
  return [&](Single& z, const Single& r) {
    numeric::multiply_blocks_into(z, m.inverse_block, r, w.team);
    numeric::add_coarse_correction_into(z, m.coarse, r, w.coarse, w.team);
  };
}

inline constexpr int max_iterations = 4000;  // of one conjugate-gradient solve

// The same in double, for any matrix: it need not be fast.
numeric::SolveOutcome improve_in_double(
    const Model& m, State& s, Scratch& w, double target,
    const std::function<void(numeric::NodeVector&, const numeric::NodeVector&)>& multiply);

// Improves the tissue's velocity until `w.imbalance`, which is what it leaves, is below `target`, in the
// precision that the scene asks for; multiply as in numeric::improve_refined_into.
template <class Multiply>
numeric::SolveOutcome improve_velocity(const Model& m, State& s, Scratch& w, double target,
                                       const Multiply& multiply) {
  numeric::SolveOutcome outcome =
      m.scene.run.solver_precision == Precision::single_
          ? numeric::improve_refined_into(s.velocity, w.imbalance, target, max_iterations,
                                          w.corotation.is_single(), w.solver, multiply, preconditioner(m, w),
                                          w.team)
          : improve_in_double(m, s, w, target, std::cref(multiply));
  outcome.broke_down = outcome.broke_down || outcome.residual_norm > target;
  return outcome;
}

// The solved velocity carried out.
void move_tissue(const Model& model, State& state, Scratch& scratch, TissueBefore& before,
                 const StepProbe& probe);

// Tissue's lines of the ledger; its kinetic energy replaces the line.
void account_tissue(const Model& model, State& state, const Scratch& scratch, const TissueBefore& before);

}  // namespace acus
