#include "acus/needle/elastica.h"

#include <cassert>
#include <cmath>
#include <numbers>

#include "acus/needle/buckling.h"
#include "acus/numeric/circular.h"
#include "acus/numeric/elliptic.h"
#include "acus/numeric/root.h"

// Let theta be the angle of the tangent against the line of the end force F, and lambda = sqrt(F / EI). Then
//   theta'' = -lambda^2 sin(theta)
// is solved, with the phase t(s), by
//   sin(theta / 2) = k cos t,   t' = lambda sqrt(1 - k^2 cos^2 t),   theta' = -2 k lambda sin t,
// so that with the integrals of Legendre taken from t = 0 (where the moment is zero),
//   m(t) = F(t - pi/2, k) + K(k),   e(t) = E(t - pi/2, k) + E(k),
// arc length and place are
//   lambda s = m(t),   lambda x = 2 e(t) - m(t),   lambda y = 2 k sin t,
// and the bending energy between two phases is (EI lambda) 2 [e - (1 - k^2) m].
// Each support is a piece of this curve, tip first:
//   pinned_pinned    0 .. pi         clamped_free  0 .. pi/2 (tip .. root)
//   clamped_clamped  pi/2 .. 5 pi/2  (both ends parallel to the force)
//   clamped_pinned   0 .. T          T such that the tangent at the hub points to the tip:
//                                    y(T) / x(T) = tan theta(T);  k = 0 gives tan T = T.
namespace acus::needle {
namespace {

using std::numbers::pi;

struct Place {
  double arc, x, y;  // times lambda, from t = 0
  double second;     // e(t)
};

Place place(double phase, double modulus) {
  const auto complete = numeric::complete_elliptic(modulus);
  const auto incomplete = numeric::incomplete_elliptic(phase - pi / 2.0, modulus);
  const double first = incomplete.first + complete.first;
  const double second = incomplete.second + complete.second;
  return {first, 2.0 * second - first, 2.0 * modulus * numeric::sin(phase), second};
}

double tangent_angle(double phase, double modulus) {
  return 2.0 * numeric::asin(modulus * numeric::cos(phase));
}

// T of the clamped-pinned column: between pi and the root of tan z = z, which it leaves downwards as k grows.
double clamped_pinned_phase(double modulus) {
  // sin T cos(theta) - (2e - m) sin(theta) / (2k), finite at k = 0.
  const auto misalignment = [&](double t) {
    const double s = modulus * numeric::cos(t);
    return numeric::sin(t) * (1.0 - 2.0 * s * s) -
           place(t, modulus).x * numeric::cos(t) * std::sqrt(1.0 - s * s);
  };
  constexpr double margin = 1e-2;  // rad, so that the root at k = 0 lies inside the bracket
  return numeric::bracketed_root(misalignment, pi, clamped_pinned_root + margin);
}

struct Phases {
  double tip, bow, hub;
};

Phases phases(Support support, double modulus) {
  switch (support) {
    case Support::pinned_pinned:
      return {0.0, pi / 2.0, pi};
    case Support::clamped_clamped:
      return {pi / 2.0, 1.5 * pi, 2.5 * pi};
    case Support::clamped_free:
      return {0.0, 0.0, pi / 2.0};
    case Support::clamped_pinned: {
      // The bow is largest where the tangent is parallel to the axis, that is to the tangent at the hub.
      const double hub = clamped_pinned_phase(modulus);
      return {0.0, 2.0 * pi - hub, hub};
    }
  }
  assert(false);
  return {};
}

// Place relative to the hub: along the axis towards the tip, and across it. Times lambda.
ElasticaPoint from_hub(const Place& here, const Place& hub, double axis_angle) {
  const double dx = hub.x - here.x;
  const double dy = here.y - hub.y;
  return {dx * numeric::cos(axis_angle) - dy * numeric::sin(axis_angle),
          dx * numeric::sin(axis_angle) + dy * numeric::cos(axis_angle)};
}

Elastica elastica_of_modulus(Support support, double modulus) {
  const Phases phase = phases(support, modulus);
  const Place tip = place(phase.tip, modulus);
  const Place hub = place(phase.hub, modulus);
  Elastica e{};
  e.modulus = modulus;
  e.tip_phase = phase.tip;
  e.hub_phase = phase.hub;
  e.reduced_length = hub.arc - tip.arc;
  e.axis_angle = support == Support::clamped_pinned ? tangent_angle(phase.hub, modulus) : 0.0;
  const double reduced_critical_load = critical_load(1.0, 1.0, support);  // Pcr l^2 / EI
  e.shortening_ratio = 1.0 - from_hub(tip, hub, e.axis_angle).axial / e.reduced_length;
  e.load_ratio = e.reduced_length * e.reduced_length * numeric::cos(e.axis_angle) / reduced_critical_load;
  const double bow = from_hub(place(phase.bow, modulus), hub, e.axis_angle).lateral;
  e.side = bow < 0.0 ? -1.0 : 1.0;
  e.bow_ratio = e.side * bow / e.reduced_length;
  e.tip_slope = tangent_angle(phase.tip, modulus) - e.axis_angle;
  e.lateral_ratio = std::abs(numeric::tan(e.axis_angle));
  e.energy_ratio = 2.0 * e.reduced_length / reduced_critical_load *
                   (hub.second - tip.second - (1.0 - modulus) * (1.0 + modulus) * e.reduced_length);
  return e;
}

// A modulus whose shortening is a little more than max_shortening_ratio.
double max_modulus(Support support) { return support == Support::clamped_pinned ? 0.83 : 0.90; }

}  // namespace

double max_shortening_ratio(Support support) { return support == Support::clamped_pinned ? 0.70 : 0.90; }

Elastica elastica(Support support, double shortening_ratio) {
  assert(shortening_ratio >= 0.0 && shortening_ratio <= max_shortening_ratio(support));
  if (shortening_ratio == 0.0) return elastica_of_modulus(support, 0.0);
  // The rounding of 1 - span / length at k = 0 is taken out, so that the smallest shortenings stay bracketed.
  const double rounding = elastica_of_modulus(support, 0.0).shortening_ratio;
  const auto excess = [&](double modulus) {
    return elastica_of_modulus(support, modulus).shortening_ratio - rounding - shortening_ratio;
  };
  return elastica_of_modulus(support, numeric::bracketed_root(excess, 0.0, max_modulus(support)));
}

// pinned_pinned: d = k^2, bow = 2k/pi; clamped_clamped the same; clamped_free: bow = 4k/pi. clamped_pinned:
// the mode w = sin t - t cos T with tan T = T has the shortening (1/2)(1/T) integral of w'^2 = sin^2 T / 4
// and the bow w(2 pi - T) / T = 2 pi |cos T| / T, so that d / bow^2 = T^2 tan^2 T / (16 pi^2) = T^4 / (16
// pi^2).
double small_bow_factor(Support support) {
  if (support == Support::clamped_free) return pi * pi / 16.0;
  if (support != Support::clamped_pinned) return pi * pi / 4.0;
  constexpr double root_squared = clamped_pinned_root * clamped_pinned_root;
  return root_squared * root_squared / (16.0 * pi * pi);
}

ElasticaPoint elastica_point(const Elastica& e, double arc_ratio) {
  assert(arc_ratio >= 0.0 && arc_ratio <= 1.0);
  const double tip_arc = place(e.tip_phase, e.modulus).arc;
  const double arc = tip_arc + (1.0 - arc_ratio) * e.reduced_length;
  const double quarter = numeric::complete_elliptic(e.modulus).first;
  const double phase = pi / 2.0 + numeric::jacobi_amplitude(arc - quarter, e.modulus);
  const ElasticaPoint p = from_hub(place(phase, e.modulus), place(e.hub_phase, e.modulus), e.axis_angle);
  return {p.axial / e.reduced_length, e.side * p.lateral / e.reduced_length};
}

}  // namespace acus::needle
