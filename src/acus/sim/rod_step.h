// One time step of a needle that is a rod, top to bottom: touch the tissue, advance rod and tissue together, cut, account for
// the energy, decide the stage.
#pragma once

#include <vector>

#include "acus/sim/scratch.h"
#include "acus/sim/state.h"
#include "acus/sim/step_probe.h"

namespace acus {

// As `advance` of step.h; the hub ends the step at `hub`, of which the travel along the path is `hand_travel` [m].
void advance_rod(const Model& model, State& state, Scratch& scratch, const needle::Pose& hub, double hand_travel, Frame& frame,
                 std::vector<Event>& events, const StepProbe& probe = {});

}  // namespace acus
