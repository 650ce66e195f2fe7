// How the needle is supported outside of the tissue: by the hand, by its supports at both ends, and by a
// guide around it. What follows from that for the closed forms.
#pragma once

#include "acus/sim/scene.h"

namespace acus {

// The part of the needle in front of the hand, which is all that bends: a needle of its own, as much shorter
// as the hand holds it from its hub, with an initial bow of the same share of its length. What is behind the
// hand hangs free.
needle::NeedleSpec in_front_of_hand(const Scene& scene);

// A part of the needle that can buckle for itself.
struct Span {
  double length;  // m
  needle::Support support;
};

// Supports of what is above a guide.
needle::Support above_guide(needle::Support support);

// Of a free part of that length [m], the span that buckles first. In a guide a needle neither moves aside nor
// turns; it holds the ends of the spans before and behind it as a clamp does. That is exact for a stiff guide
// longer than a few (4 EI / stiffness)^(1/4), and too much for a short or soft one. A span is at least as
// long as a stub (needle_spec.h).
Span weakest_span(const Scene& scene, double free_length);

// N, the closed form for a free part of that length; and for all that is in front of the hand.
double critical_load(const Scene& scene, double free_length);
double critical_load(const Scene& scene);

}  // namespace acus
