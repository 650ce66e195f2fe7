// How a rod and the tissue hold each other: at the tip, and cell by cell along the channel.
#pragma once

#include "acus/sim/scratch.h"
#include "acus/sim/state.h"

namespace acus {

// Where the rod is in the tissue.
struct RodPlace {
  double inserted_length = 0.0;  // m, inside
  double free_length = 0.0;      // m, between hub and entry
  double covered_depth = 0.0;    // m, rest length of the channel that the shaft fills
  double bow = 0.0;              // m, largest distance of the free part from the line hub-entry
  double bow_ratio = 0.0;        // the same over the free length; with a guide, of the span that is bent most
  double span = 0.0;             // m, length of that part
};
RodPlace place_rod(const Model& model, const State& state);

// Lays the rod over its channel and lists what can hold it there, the tip first; each on the branch that the
// present rates lead to. What its springs hold less than they did, because the rod's points have slid on to
// other places, is booked as lost.
void touch_rod(const Model& model, State& state, Scratch& scratch);

// Of the rod's point: what its nodes have in a vector of the rod's unknowns, rates or changes.
Vec3 at_contact(const std::vector<double>& unknowns, const RodContact& contact);
// m/s, of the tissue there.
Vec3 tissue_rate(const State& state, const RodContact& contact);

// N m, about the axis: what is held beside it turns the rod, by the force it had before the step.
double turning_moment(const RodContact& contact);

// N, of the tissue's resistance to the rod after a way [m] of the rod's point against it, whatever the
// branch. The rod feels the opposite.
Vec3 contact_load(const RodContact& contact, const Vec3& way);

// The branches that the present rates lead to. Returns whether any changed.
bool correct_grips(const Model& model, const State& state, Scratch& scratch);

// Carries out the contacts' steps once rod and tissue have moved: books friction, cutting and what the
// implicit step lost, and leaves the energy of the springs as line of the ledger.
coupling::NeedleSlide slide_rod(const Model& model, State& state, const Scratch& scratch);

// The cut goes on in the direction of the tip by what it slipped in the step `tip`, and the channel with it.
// Returns whether it has come out.
bool cut_along_tip(const Model& model, State& state, const coupling::SliderStep& tip);

}  // namespace acus
