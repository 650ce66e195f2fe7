// Prediction: what the closed forms say of a scene before anything is simulated.
#pragma once

#include <string>

#include "acus/sim/scene.h"
#include "acus/sim/summary.h"

namespace acus {

struct Prediction {
  double critical_load;  // N, Eq. 10 with the scene's support on the whole length
  double highest_load;   // N, most that the column can push within the hand's travel, buckled or not
  double sink;           // m, of the entry under the rupture force: half-space, mean over the contact disc
  double
      longest_straight;  // m, free length up to which the column carries the rupture force without buckling
  Outcome outcome;
};

// The exact elastica gives the loads after buckling. The half-space sinks less than a thin block on a
// slippery bed and more than a thick block on a fixed one; dynamics, friction and the needle's imperfection
// are left out.
Prediction predict(const Scene& scene);

// What is to be expected, for people: "buckles at 0.642 N, the tissue ruptures at 1.00 N: this needle ...".
std::string in_words(const Scene& scene, const Prediction& prediction);

// Mean sink of a uniform pressure over a disc on a half-space, 16 (1 - nu^2) F / (3 pi^2 E a) (Timoshenko and
// Goodier, Theory of Elasticity, 139). m
double half_space_sink(double force, const TissueScene& tissue, double disc_radius);

}  // namespace acus
