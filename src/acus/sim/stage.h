// Stages and events (the paper's Fig. 4 and 6), told from what the mechanics did.
#pragma once

#include <vector>

#include "acus/sim/state.h"

namespace acus {

// A column counts as buckled once it carries the closed form's critical load, and as straight again below
// this share of it: there the bow is within ten times the initial one (P / P_cr = 1 - A_0 / A).
inline constexpr double straight_again = 0.9;

struct Observed {
  double tip_force = 0.0;        // N
  double column_load = 0.0;      // N
  double critical_load = 0.0;    // N
  double inserted_length = 0.0;  // m
  bool ruptured_now = false;
  bool through_now = false;
};

// Updates state.buckled, and writes stage and events of the step that `frame` describes.
void decide_stage(State& state, const Observed& observed, Frame& frame, std::vector<Event>& events);

}  // namespace acus
