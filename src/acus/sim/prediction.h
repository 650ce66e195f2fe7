// Prediction: what the closed forms say of a scene before anything is simulated.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "acus/sim/scene.h"
#include "acus/sim/summary.h"

namespace acus {

// Where in the push a column is expected to give way.
struct ExpectedBuckling {
  double load;         // N
  double hand_travel;  // m, from first touch; about, for the half-space sinks otherwise than a block
  bool inside;         // after the puncture: the paper's second buckling
};

struct Prediction {
  double critical_load;     // N, Eq. 10 for all that is in front of the hand, as the scene supports it
  double highest_load;      // N, most that the column can push within the hand's travel, buckled or not, and
                            // that a person does
  double sink;              // m, of the entry under the rupture force: half-space, mean over the contact disc
  double longest_straight;  // m, of the span that buckles first, up to which it carries the rupture force
  double longest_in_sleeve;  // m, the same between the hand and a sleeve that stands on the tissue
  double least_radius;       // m, from which on the column carries the rupture force unbuckled
  std::optional<ExpectedBuckling> buckling;  // the first; none within the hand's travel and force
  Outcome outcome;
};

// The exact elastica gives the loads after buckling. The half-space sinks less than a thin block on a
// slippery bed and more than a thick block on a fixed one; dynamics, friction and the needle's imperfection
// are left out; so is what rubs in a guide.
Prediction predict(const Scene& scene);

// What is to be expected, for people: "buckles at 0.642 N, the tissue ruptures at 1.00 N: this needle ...".
std::string in_words(const Scene& scene, const Prediction& prediction);

// Whether, where and under what this needle buckles, in a sentence.
std::string buckling_in_words(const Scene& scene, const Prediction& prediction);

// What keeps it straight up to the puncture, or how much it could lose and still be so: a sentence each.
// Empty against a fixed stop, which is never punctured.
std::vector<std::string> remedies_in_words(const Scene& scene, const Prediction& prediction);

// Mean sink of a uniform pressure over a disc on a half-space, 16 (1 - nu^2) F / (3 pi^2 E a) (Timoshenko and
// Goodier, Theory of Elasticity, 139). m
double half_space_sink(double force, const TissueScene& tissue, double disc_radius);

}  // namespace acus
