// One implicit step of rod and tissue together.
//
// Unknowns: the rates of the rod and the velocities v of the tissue. With the rod at an iterate of Newton's
// method (rod_motion.h), and contacts that answer d, the way of the rod's points against the tissue, by f_c -
// K_c d:
//   (M_r + h^2 (H + J^T K J)) dw = r - h^2 J^T K (J w - C v) + h J^T f,
//   (A_t + h^2 C^T K C) v        = b - h C^T f + h^2 C^T K J (w + dw),
// J the rod's and C the tissue's rows of the contacts. The rod's matrix is banded and factored exactly, so dw
// is put into the second line and conjugate gradients find v alone: each product asks the rod for its answer,
// and however stiff the steel is, their number does not grow.
#pragma once

#include "acus/sim/scratch.h"
#include "acus/sim/state.h"
#include "acus/sim/step_probe.h"

namespace acus {

struct RodOutcome {
  int iterations = 0;
  bool broke_down = false;
  bool tissue_solved = true;      // to the tolerance
  Vec3 hub_force{0.0, 0.0, 0.0};  // N, of the hub on the rod
};

// Advances state.velocity and state.needle.rod. `scratch` holds the tissue's matrix and momentum and the
// contacts. The hub ends the step at `hub`; a grip lets node 0 stay behind along the path.
RodOutcome solve_with_rod(const Model& model, State& state, Scratch& scratch, const needle::Pose& hub,
                          const StepProbe& probe);

// How the force on the hub would have grown with its travel in the step that was solved last, N/m, at least
// 0; in series with the grip. Takes iterations of its own and leaves the state alone; 0 when they do not end.
double hub_stiffness(const Model& model, const State& state, Scratch& scratch);

}  // namespace acus
