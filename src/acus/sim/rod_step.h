// One time step of a needle that is a rod, top to bottom: touch the tissue, advance rod and tissue together,
// cut, account for the energy, decide the stage.
#pragma once

#include <vector>

#include "acus/sim/scratch.h"
#include "acus/sim/state.h"
#include "acus/sim/step_probe.h"

namespace acus {

// As `advance` of step.h. The hub ends the step at `hub`, turned by less than a right angle in the step; a
// grip lets node 0 stay behind along the path.
void advance_rod(const Model& model, State& state, Scratch& scratch, const needle::Pose& hub, Frame& frame,
                 std::vector<Event>& events, const StepProbe& probe = {});

}  // namespace acus
