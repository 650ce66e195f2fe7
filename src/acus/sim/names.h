// The words for stages, events, outcomes, health and parts of a step in every file, table and message.
#pragma once

#include <string>

#include "acus/needle/needle_spec.h"
#include "acus/sim/frame.h"
#include "acus/sim/step_probe.h"
#include "acus/sim/summary.h"

namespace acus {

std::string name_of(Stage stage);
std::string name_of(EventKind kind);
std::string name_of(Outcome outcome);
std::string name_of(Health health);
std::string name_of(needle::Support support);
std::string name_of(StepPart part);

}  // namespace acus
