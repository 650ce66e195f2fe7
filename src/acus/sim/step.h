// One time step, top to bottom: touch the tissue, assemble, advance needle and tissue together, cut, account
// for the energy, decide the stage.
#pragma once

#include <vector>

#include "acus/sim/coupled_solve.h"
#include "acus/sim/step_probe.h"

namespace acus {

// The hand ends the step at `hand_travel` [m]. Writes what is seen of it into `frame` and appends to
// `events`, whose capacity the caller has reserved. A step that fails says so in frame.health and leaves
// frame.time where it was.
void advance(const Model& model, State& state, Scratch& scratch, double hand_travel, Frame& frame,
             std::vector<Event>& events, const StepProbe& probe = {});

}  // namespace acus
