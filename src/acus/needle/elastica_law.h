// The elastica's load as a function of end shortening, for every time step: Chebyshev series made once from
// the exact elastica, smooth, with their exact integrals. Only + - * / and square roots at run time: the same
// bits everywhere.
#pragma once

#include "acus/needle/needle_spec.h"
#include "acus/numeric/chebyshev.h"

namespace acus::needle {

// p(d) = P / Pcr of the elastica, d = end shortening / length. Beyond max_shortening_ratio p keeps its last
// value: the column is folded, the force stays finite and remains the derivative of the energy.
struct ElasticaLaw {
  double max_shortening_ratio;
  double root_of_max;                      // its square root
  numeric::ChebyshevSeries load;           // p
  numeric::ChebyshevSeries energy;         // integral of p(s) ds from 0 to d
  numeric::ChebyshevSeries root_integral;  // integral of p(t^2) dt from 0 to y, odd in y = sqrt(d)
  numeric::ChebyshevSeries bow;            // bow / (l sqrt(d))
};

ElasticaLaw build_elastica_law(Support support);

// p(d) and dp/dd, d >= 0.
numeric::ValueAndSlope load_ratio(const ElasticaLaw& law, double shortening_ratio);
// Pi(d): the integral of p from 0 to d, d >= 0.
double energy_ratio(const ElasticaLaw& law, double shortening_ratio);
// Psi(y): the integral of p(t^2) dt from 0 to y, y >= 0.
double root_integral(const ElasticaLaw& law, double root_of_shortening_ratio);
// Bow / l at d = y^2, y >= 0 (beyond the range: at its end).
double bow_ratio(const ElasticaLaw& law, double root_of_shortening_ratio);

}  // namespace acus::needle
