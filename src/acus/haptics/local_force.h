// What the simulation last said about the force on the hand, in a form that answers in nanoseconds: the force
// at one place, how it changes there, and how far that may be trusted.
#pragma once

#include <algorithm>

namespace acus::haptics {

struct LocalForce {
  double time = -1.0;  // s, of the loop's clock, when the simulation said so; negative: it has not spoken yet
  double travel = 0.0;     // m, of the hand along the needle, 0 at first touch
  double force = 0.0;      // N, positive against the hand
  double stiffness = 0.0;  // N/m
  double radius = 0.0;     // m, on both sides of `travel`
  bool jumped =
      false;  // the needle has buckled, punctured or slipped since the last word: that one counts no more
  double work = 0.0;  // J, that grip and needle have taken from the hand until then
  double felt = 0.0;  // J, that the hand had felt to do until then
};

// Within the radius; beyond it, what holds at its rim. N
inline double force_at(const LocalForce& local, double travel) {
  return local.force + local.stiffness * std::clamp(travel - local.travel, -local.radius, local.radius);
}

}  // namespace acus::haptics
