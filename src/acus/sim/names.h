// The words for stages, events, outcomes and health in every file, table and message.
#pragma once

#include <string>

#include "acus/needle/needle_spec.h"
#include "acus/sim/frame.h"
#include "acus/sim/summary.h"

namespace acus {

std::string name_of(Stage stage);
std::string name_of(EventKind kind);
std::string name_of(Outcome outcome);
std::string name_of(Health health);
std::string name_of(needle::Support support);

}  // namespace acus
