// The free part of the needle as an imperfect column: what it answers when its ends are brought closer
// together.
#pragma once

#include <vector>

#include "acus/needle/elastica.h"
#include "acus/needle/elastica_law.h"
#include "acus/needle/needle_spec.h"

namespace acus::needle {

// Constants of one needle.
struct Column {
  Support support;
  double critical_load_times_length_squared;  // C = Pcr l^2, N m^2
  double axial_rigidity;                      // EA, N
  double initial_shortening_ratio;            // d0, the shortening of an elastica with the initial bow
  double initial_root;                        // y0 = sqrt(d0)
  double initial_energy_ratio;                // Pi(d0)
  double initial_root_integral;               // Psi(y0)
  ElasticaLaw law;
};

// `spec` must be valid: positive length, radius and Young's modulus, 0 <= imperfection <= length / 10.
Column build_column(const NeedleSpec& spec);

// The answer of a free part of given length to a given shortening of the distance between its ends.
struct ColumnResponse {
  double load;                   // P, N, along the axis; positive when it pushes the ends apart
  double stiffness;              // dP / d(shortening) at fixed free length, N/m
  double configurational_force;  // G = dU / d(free length) at fixed shortening, N
  double energy;                 // U, J, bending and axial compression
  double bow;                    // m, largest distance from the axis (clamped_free: deflection of the tip)
  double shortening_ratio;       // d, the part of the shortening that is due to bending / free length
  bool folded;                   // the bow is beyond max_shortening_ratio: the load is held at its last value
};

// Any finite shortening [m], negative for tension. Free length [m] of at least shortest_column radii: a stub
// is no column, and its load falls so steeply in the far post-buckling of clamped_pinned that shortening no
// longer fixes it. Whoever holds the hub may give way by `grip_compliance` [m/N]: `shortening` is then what
// column and grip take together; the answer is the column's alone.
ColumnResponse column_response(const Column& column, double free_length, double shortening,
                               double grip_compliance = 0.0);

// The centre line of the free part, for drawings.
struct ColumnCurve {
  Elastica elastica;
  double axial_scale;  // m
  double free_length;  // m
};
ColumnCurve column_curve(const Column& column, double free_length, double shortening);
// Its point at arc_ratio of its length, m: hub at 0 (axial 0), entry at 1 (axial free_length - shortening).
ElasticaPoint point_at(const ColumnCurve& curve, double arc_ratio);
// `points` >= 2 points evenly along its arc. Takes some 0.1 ms.
std::vector<ElasticaPoint> column_line(const Column& column, double free_length, double shortening,
                                       int points);

}  // namespace acus::needle
