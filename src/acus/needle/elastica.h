// The exact elastica after buckling: an inextensible column of length l and bending rigidity EI whose ends
// have come closer by the end shortening d l. All quantities are ratios: lengths to l, loads to the critical
// load of the same supports, energies to (critical load x l). Slow (a root search): for tests, drawings and
// building ElasticaLaw.
#pragma once

#include "acus/needle/needle_spec.h"

namespace acus::needle {

struct Elastica {
  // The curve, as a piece of an inflectional elastica between two phases (see elastica.cpp).
  double modulus;         // k
  double tip_phase;       // rad
  double hub_phase;       // rad
  double reduced_length;  // l sqrt(F / EI), F the whole end force
  double axis_angle;      // rad, of the needle's axis against the end force; not 0 for clamped_pinned alone
  double side;            // 1 or -1: turns the bow to the positive side of the axis

  // What a user wants to know.
  double shortening_ratio;  // d
  double load_ratio;        // P / Pcr, P the force along the axis
  double bow_ratio;         // largest distance from the axis; clamped_free: deflection of the tip
  double tip_slope;         // rad, between the tangent at the tip and the axis
  double lateral_ratio;     // force across the axis / force along it; not 0 for clamped_pinned alone
  double energy_ratio;      // bending energy / (Pcr l); its derivative by d is load_ratio
};

// The largest end shortening the functions here accept. pinned_pinned, clamped_clamped and clamped_free carry
// a load that grows with d without end, and 0.9 is far past any use. The load of clamped_pinned has its
// largest value, 1.140 Pcr, at d = 0.454; it falls from there, is 0.84 Pcr at 0.70 (tip slope 165 deg), zero
// at 0.82, and beyond that the tip must be pulled. We stop at 0.70.
double max_shortening_ratio(Support support);

// The elastica of first mode at 0 <= shortening_ratio <= max_shortening_ratio(support).
Elastica elastica(Support support, double shortening_ratio);

// Limit of d / bow_ratio^2 as d tends to 0: pi^2/4; z^4/(16 pi^2) = 2.58 with tan z = z; pi^2/4; pi^2/16.
double small_bow_factor(Support support);

struct ElasticaPoint {
  double axial;    // from the hub along the axis towards the tip, / l
  double lateral;  // across the axis, to the side of the bow, / l
};
// The point at arc length arc_ratio * l from the hub, 0 <= arc_ratio <= 1.
ElasticaPoint elastica_point(const Elastica& elastica, double arc_ratio);

}  // namespace acus::needle
