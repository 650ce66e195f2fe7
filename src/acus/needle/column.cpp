#include "acus/needle/column.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "acus/needle/buckling.h"

namespace acus::needle {
namespace {

using numeric::ValueAndSlope;

// The root of a function that rises through it between `low` and `high`: Newton's steps from `start`, and
// bisection where they would leave. Newton's error after a step is at most about (step / y)^2 y for the
// cubics below, so that the last step leaves less than rounding.
template <class Equation>
double rising_root(Equation&& equation, double low, double high, double start) {
  constexpr int max_steps = 100;
  constexpr double last_step = 1e-9;
  double y = start;
  for (int i = 0; i < max_steps; ++i) {
    const ValueAndSlope f = equation(y);
    (f.value > 0.0 ? high : low) = y;
    const double newton = y - f.value / f.slope;
    const double next = newton >= low && newton <= high ? newton : 0.5 * (low + high);
    const double step = std::abs(next - y);
    y = next;
    if (step <= last_step * y) break;
  }
  return y;
}

// The root y >= 0 of the compatibility of bow and compression (see column_response), multiplied by y:
//   f(y) = y^3 - D y + epsilon p(y^2) (y - y0),   D = d0 + shortening / l,   epsilon = Pcr (1 / EA + c / l).
// f <= 0 at y = 0 and f >= 0 at y = max(sqrt(D), y0), so the root is bracketed. p is near 1 and epsilon
// small: the cubic with p = 1, to whose root Newton comes down from the right without overshooting, leaves
// one or two steps to do.
double root_of_bow(const Column& column, double total_ratio, double compression_ratio) {
  const double y0 = column.initial_root;
  const auto equation = [&](double y, ValueAndSlope p) {
    return ValueAndSlope{
        y * (y * y - total_ratio) + compression_ratio * p.value * (y - y0),
        3.0 * y * y - total_ratio + compression_ratio * (p.value + 2.0 * y * p.slope * (y - y0))};
  };
  // A perfect column below its critical load is straight, and only compressed.
  if (y0 == 0.0 && total_ratio <= compression_ratio * load_ratio(column.law, 0.0).value) return 0.0;
  const double high = std::fmax(std::sqrt(std::fmax(total_ratio, 0.0)), y0);
  const double start = rising_root([&](double y) { return equation(y, {1.0, 0.0}); }, 0.0, high, high);
  return rising_root([&](double y) { return equation(y, load_ratio(column.law, y * y)); }, 0.0, high, start);
}

}  // namespace

Column build_column(const NeedleSpec& spec) {
  assert(spec.length > 0.0 && spec.radius > 0.0 && spec.youngs_modulus > 0.0);
  assert(spec.imperfection >= 0.0 && spec.imperfection <= 0.1 * spec.length);
  Column column{};
  column.support = spec.support;
  column.critical_load_times_length_squared = critical_load(bending_rigidity(spec), 1.0, spec.support);
  column.axial_rigidity = axial_rigidity(spec);
  const double bow = spec.imperfection / spec.length;
  column.initial_shortening_ratio = small_bow_factor(spec.support) * bow * bow;
  column.initial_root = std::sqrt(column.initial_shortening_ratio);
  column.law = build_elastica_law(spec.support);
  column.initial_energy_ratio = energy_ratio(column.law, column.initial_shortening_ratio);
  column.initial_root_integral = root_integral(column.law, column.initial_root);
  return column;
}

// Symbols: l = free_length, delta = shortening, C = Pcr l^2, EA = axial_rigidity, p(d) the load of the
// perfect elastica over Pcr at the shortening ratio d, Pi(d) its integral.
//
// The bow. A perfect column of shortening d l has the bending energy (C/l) Pi(d) and carries Pcr p(d); its
// bow grows as y = sqrt(d). Let the unloaded needle have the bow y0 = sqrt(d0); a shortening d l from there
// makes it
//   y = sqrt(d + d0).
// For small bows Perry's imperfect column carries P = Pcr (1 - A0/A), where A0 is the bow unloaded and A
// loaded; for large ones the elastica carries Pcr p. Both hold in
//   P = Pcr p(y^2) (1 - y0 / y),
// which is zero at d = 0, tends to Pcr at small y0, and to minus infinity as tension pulls the bow straight
// (y -> 0). d0 is the same fraction of any free length: the initial bow stays similar to itself while the
// needle goes in.
//
// Its energy is the integral of P l over d. With dd = 2 y dy and Psi(y) the integral of p(t^2) dt,
//   U_bow = (C/l) Phi,   Phi = Pi(y^2) - Pi(d0) - 2 y0 (Psi(y) - Psi(y0)).
//
// Compression is in series with the bow:
//   delta = d l + P l / EA,   U = U_bow + P^2 l / (2 EA),
// and so is a grip that gives way by P c. Divided by l, with epsilon = Pcr (1 / EA + c / l), y solves
//   y^2 - d0 + epsilon p(y^2) (1 - y0 / y) = (delta + P c) / l.
//
// Stiffness: with dy/dd = 1 / (2 y) the bow has dP/d(d l) = (Pcr/l) [p' (1 - y0/y) + p y0 / (2 y^3)], in
// series with EA / l.
//
// Configurational force: U(delta, l) is stationary in d, so only the explicit l in
//   U = (C/l) Phi(d) + (EA / 2l) (delta - d l)^2
// counts:
//   G = dU/dl = -Pcr Phi - P^2 / (2 EA) - P d.
// For a perfect column P + G is the end force times the cosine of its angle with the needle where the moment
// is zero; for pinned_pinned P + G = P cos(end slope).
ColumnResponse column_response(const Column& column, double free_length, double shortening,
                               double grip_compliance) {
  assert(free_length > 0.0 && std::isfinite(shortening));
  const double critical_load = column.critical_load_times_length_squared / (free_length * free_length);
  const double compression_ratio =
      critical_load / column.axial_rigidity + critical_load * grip_compliance / free_length;
  const double axial_stiffness = column.axial_rigidity / free_length;
  const double d0 = column.initial_shortening_ratio;
  const double y0 = column.initial_root;

  const double y = root_of_bow(column, d0 + shortening / free_length, compression_ratio);
  const double d = y * y - d0;
  const auto [p, slope] = load_ratio(column.law, y * y);
  ColumnResponse r{};
  if (y == 0.0) {  // straight
    r.load = axial_stiffness * shortening / (1.0 + axial_stiffness * grip_compliance);
    r.stiffness = axial_stiffness;
  } else {
    const double growth = 1.0 - y0 / y;
    const double bow_stiffness = critical_load / free_length * (slope * growth + 0.5 * p * y0 / (y * y * y));
    r.load = critical_load * p * growth;
    r.stiffness = axial_stiffness * bow_stiffness / (axial_stiffness + bow_stiffness);
  }
  const double phi = energy_ratio(column.law, y * y) - column.initial_energy_ratio -
                     2.0 * y0 * (root_integral(column.law, y) - column.initial_root_integral);
  const double compression_energy = 0.5 * r.load * r.load / column.axial_rigidity;  // per length
  r.energy = free_length * (critical_load * phi + compression_energy);
  r.configurational_force = -critical_load * phi - compression_energy - r.load * d;
  r.bow = free_length * bow_ratio(column.law, y);
  r.shortening_ratio = d;
  r.folded = y * y > column.law.max_shortening_ratio;
  return r;
}

ColumnCurve column_curve(const Column& column, double free_length, double shortening) {
  const ColumnResponse r = column_response(column, free_length, shortening);
  const double total_ratio = r.shortening_ratio + column.initial_shortening_ratio;
  const Elastica curve =
      elastica(column.support, std::clamp(total_ratio, 0.0, column.law.max_shortening_ratio));
  // The elastica's span lacks the compression P l / EA and the initial shortening; stretching it puts the
  // ends in place.
  return {curve, (free_length - shortening) / (1.0 - curve.shortening_ratio), free_length};
}

ElasticaPoint point_at(const ColumnCurve& curve, double arc_ratio) {
  const ElasticaPoint p = elastica_point(curve.elastica, arc_ratio);
  return {curve.axial_scale * p.axial, curve.free_length * p.lateral};
}

std::vector<ElasticaPoint> column_line(const Column& column, double free_length, double shortening,
                                       int points) {
  assert(points >= 2);
  const ColumnCurve curve = column_curve(column, free_length, shortening);
  std::vector<ElasticaPoint> line(static_cast<std::size_t>(points));
  for (int i = 0; i < points; ++i)
    line[static_cast<std::size_t>(i)] = point_at(curve, static_cast<double>(i) / (points - 1));
  return line;
}

}  // namespace acus::needle
