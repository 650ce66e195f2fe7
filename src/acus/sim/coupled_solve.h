// One implicit step of needle and tissue together.
//
// Unknowns: the velocities v of the tissue and the one rate w of the needle along its axis. With P the
// force of the column and the hand's grip at X1 - z0 - h w, X1 the hand, and f_j the sliders between needle
// and tissue (tip contact, friction),
//   A v = M v0 + h f_el + h sum_j f_j(w - W_j v) W_j^T a,
//   0 = P(X1 - z0 - h w) - sum_j f_j(w - W_j v) - Q,
// where W_j are the weights of attachment j, a the axis and Q the configurational force at the entry. On its
// branch every f_j is linear, so v = v_0 + w y with y the tissue's answer to a unit rate, and w is the root
// of one monotone scalar equation: nothing lags, nothing chatters at the buckling load however stiff the
// steel. Branches are corrected and the two solves repeated until they hold (a semismooth Newton method).
#pragma once

#include "acus/sim/scratch.h"
#include "acus/sim/state.h"
#include "acus/sim/step_probe.h"

namespace acus {

struct CoupledOutcome {
  int iterations = 0;
  bool broke_down = false;  // a solve failed, or no consistent branches were found
};

// Advances state.velocity, influence and tip_rate. `scratch` holds the matrix, the momentum and the
// held points; the hand ends the step at `hand_travel`.
CoupledOutcome solve_coupled(const Model& model, State& state, Scratch& scratch, double hand_travel,
                             double free_length, double configurational_force, const StepProbe& probe);

// How the force of tissue and sliders on the needle would have grown with its rate in the step that was
// solved last. N s/m, at least 0. Takes some iterations of its own and leaves the state alone; 0 when they do
// not end.
double resistance(const Model& model, Scratch& scratch);

// What column and grip answer when together they take up so much [m] between hand and tip. N
double column_load(const Model& model, double free_length, double taken_up);

// Tissue's velocity along the axis at a held point.
double tissue_rate(const Model& model, const State& state, const HeldPoint& point);

}  // namespace acus
