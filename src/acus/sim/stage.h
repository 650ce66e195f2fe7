// Stages and events (the paper's Fig. 4 and 6), told from what the mechanics did.
#pragma once

#include <vector>

#include "acus/sim/state.h"

namespace acus {

// Whether the free part has given way sideways, as its model tells it.
enum class Bent { no, yes, in_between };  // in between it stays what it was

// Bows, over the length of the part that gives way, between hand, guide and entry: from the first on it is
// bent, below the second straight. With the default bow of L / 4000 a load is within 0.5 % of critical when
// the bow is the first.
inline constexpr double bent_ratio = 0.05, straight_ratio = 0.5 * bent_ratio;

// A column has buckled once it carries the closed form's critical load, or, where the initial bow keeps the
// load below it for long, once its bow says so. It is straight again when its bow is, below nine tenths of
// the critical load.
Bent column_bent(double load, double critical_load, double bow_ratio);
// A rod is asked for nothing but its shape. It is straight again once its bow has been so for a period of its
// slowest vibration; what has sprung straight rings for a while.
Bent rod_bent(double bow_ratio, double time_straight, double period);

struct Observed {
  double hand_force = 0.0;       // N
  double tip_force = 0.0;        // N
  double shaft_force = 0.0;      // N
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
