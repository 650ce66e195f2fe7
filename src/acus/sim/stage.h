// Stages and events (the paper's Fig. 4 and 6), told from what the mechanics did.
#pragma once

#include <vector>

#include "acus/sim/state.h"

namespace acus {

// A column counts as buckled once it carries the closed form's critical load, or, where the initial bow keeps
// the load below it for long, once its bow is this share of the free length (with the default bow of L / 4000
// the load is then within 0.5 % of critical). It is straight again at half that bow, below this share of the
// critical load.
inline constexpr double bent = 0.05;
inline constexpr double straight_again = 0.9;

struct Observed {
  double tip_force = 0.0;        // N
  double column_load = 0.0;      // N
  double critical_load = 0.0;    // N
  double bow_ratio = 0.0;        // bow / free length
  double inserted_length = 0.0;  // m
  bool ruptured_now = false;
  bool through_now = false;
};

// Updates state.buckled, and writes stage and events of the step that `frame` describes. A buckling with the
// tip inside the tissue is the paper's second one, whether or not the needle had buckled before the puncture.
void decide_stage(State& state, const Observed& observed, Frame& frame, std::vector<Event>& events);

}  // namespace acus
