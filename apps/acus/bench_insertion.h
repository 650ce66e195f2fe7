// acus bench --insertion.
#pragma once

#include "verbs.h"

namespace acus::app {

// Whole insertions of the default scene, one for each size, and what they cost. Returns the exit code.
int measure_insertions(const BenchOptions& options);

}  // namespace acus::app
