// Felt: what a hand notices of the force on it. It feels travel and force through one slow sense, expects the
// force to go on with the travel as it did, and is surprised where it does not: at contact, buckling,
// puncture. What its own motion changes is expected, so that a hand that stops or starts is not surprised by
// itself.
#pragma once

namespace acus {

struct Felt {
  double travel = 0.0;    // m
  double force = 0.0;     // N
  double expected = 0.0;  // N, at that travel
  double slope = 0.0;     // N/m, by which the expectation goes on
};

// After `time_step` [s] more with the hand at `travel` [m] under `force` [N]. A hand is attentive after a
// surprise.
Felt felt_after(Felt felt, double travel, double force, double time_step, bool attentive);

// Whether the force is another one than was expected, by more than a person can just notice.
bool surprising(const Felt& felt);

}  // namespace acus
