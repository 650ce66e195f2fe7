// Stages and events (the paper's Fig. 4 and 6), told from what the mechanics did.
#pragma once

#include <vector>

#include "acus/sim/state.h"

namespace acus {

// Whether the free part has given way sideways, as its model tells it.
enum class Bent { no, yes, in_between };  // in between it stays what it was

// A column has buckled once it carries the closed form's critical load, or, where the initial bow keeps the
// load below it for long, once its bow is 5 % of the free length (with the default bow of L / 4000 the load
// is then within 0.5 % of critical). It is straight again at half that bow, below nine tenths of the critical
// load.
Bent column_bent(double load, double critical_load, double bow_ratio);
// A rod is asked for nothing but its shape: with the default bow it carries 1.3 % less than its critical load
// when the bow is 2 % of the free length; it is straight again at half of that.
Bent rod_bent(double bow_ratio);

struct Observed {
  double hand_force = 0.0;       // N
  double tip_force = 0.0;        // N
  double inserted_length = 0.0;  // m
  double free_length = 0.0;      // m
  double bow = 0.0;              // m
  double tip_aside = 0.0;        // m
  double critical_load = 0.0;    // N
  Bent bent = Bent::no;
  bool ruptured_now = false;
  bool through_now = false;
};

// Writes what is seen of a step that is done into `frame`, updates state.buckled and state.energy_force, and
// appends to `events`. A buckling with the tip inside the tissue is the paper's second one, whether or not
// the needle had buckled before the puncture.
void show(const Model& model, State& state, const Observed& observed, Frame& frame,
          std::vector<Event>& events);

}  // namespace acus
