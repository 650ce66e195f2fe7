// What the two threads of the loop tell each other: where the hand is, and what the simulation last said
// about the force on it, in a form that answers in nanoseconds: the force at one place, how it changes there,
// and how far that may be trusted.
#pragma once

#include <algorithm>

namespace acus::haptics {

struct HandMotion {
  double travel = 0.0;  // m, along the needle, 0 at first touch
  double work = 0.0;    // J, done to the device so far
  double felt = 0.0;    // J, done against the local force so far
};

struct LocalForce {
  double time = -1.0;  // s, of the loop's clock, when the simulation said so; negative: it has not spoken yet
  double travel = 0.0;     // m, of the hand
  double force = 0.0;      // N, positive against the hand
  double stiffness = 0.0;  // N/m
  double radius = 0.0;     // m, on both sides of `travel`
  long events =
      0;  // of the needle, so far: where it has buckled, punctured or slipped, older words count no more
  double taken = 0.0;   // J, that the needle has taken from the hand on its way to `travel`
  double stored = 0.0;  // J, in grip, needle and tissue: what can come back to the hand
  HandMotion hand{};    // that the word answers
};

// Within the radius; beyond it, what holds at its rim. N
inline double force_at(const LocalForce& local, double travel) {
  return local.force + local.stiffness * std::clamp(travel - local.travel, -local.radius, local.radius);
}

}  // namespace acus::haptics
