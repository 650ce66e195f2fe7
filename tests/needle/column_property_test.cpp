// Properties that must hold for any needle, free length and shortening.
#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>

#include "acus/needle/buckling.h"
#include "acus/needle/column.h"

namespace {

using namespace acus::needle;

double any_between(double low, double high) {
  constexpr int grains = 1000000;
  return low + (high - low) * *rc::gen::inRange(0, grains + 1) / grains;
}

double any_of_any_size(double low, double high) {
  return std::exp(any_between(std::log(low), std::log(high)));
}

struct Case {
  Column column;
  double free_length;
  double euler;                // N
  double buckling_shortening;  // m, of the straight bar at the Euler load
};

Case any_case(bool may_be_perfect) {
  NeedleSpec spec;
  spec.support = *rc::gen::elementOf(all_supports);
  spec.length = any_between(0.05, 0.4);
  spec.radius = any_between(0.1e-3, 1e-3);
  spec.youngs_modulus = any_of_any_size(1e9, 400e9);
  const bool perfect = may_be_perfect && *rc::gen::inRange(0, 4) == 0;
  spec.imperfection = perfect ? 0.0 : any_of_any_size(5e-5, 5e-3) * spec.length;
  const double free_length = any_between(0.1, 1.0) * spec.length;
  const double euler = critical_load(bending_rigidity(spec), free_length, spec.support);
  return {build_column(spec), free_length, euler, euler * free_length / axial_rigidity(spec)};
}

// Half the draws around the buckling load, half in the far post-buckling (and some in tension).
double any_shortening(const Case& c) {
  if (*rc::gen::inRange(0, 2) == 0) return any_between(-2.0, 4.0) * c.buckling_shortening;
  return any_between(-0.001, 0.68) * c.free_length;
}

ColumnResponse response(const Case& c, double shortening) {
  return column_response(c.column, c.free_length, shortening);
}

// The load bends over at buckling within a shortening of about (epsilon y0)^(2/3) l, see the cubic of
// column.cpp: steps of a difference are a small part of it.
double step_of_shortening(const Case& c) {
  return 0.02 * std::pow(c.euler / c.column.axial_rigidity * c.column.initial_root, 2.0 / 3.0) *
         c.free_length;
}

template <class Function>
double slope_of(Function&& f, double x, double h) {
  return (8.0 * (f(x + h) - f(x - h)) - (f(x + 2.0 * h) - f(x - 2.0 * h))) / (12.0 * h);
}

RC_GTEST_PROP(ColumnProperty, load_is_the_slope_of_the_energy, ()) {
  const Case c = any_case(false);
  const double shortening = any_shortening(c);
  const double h = step_of_shortening(c);
  const double slope = slope_of([&](double x) { return response(c, x).energy; }, shortening, h);
  const double load = response(c, shortening).load;
  RC_ASSERT(std::abs(slope - load) < 2e-6 * (c.euler + std::abs(load)));
}

RC_GTEST_PROP(ColumnProperty, configurational_force_is_the_slope_of_the_energy_by_free_length, ()) {
  const Case c = any_case(false);
  const double shortening = any_shortening(c);
  const double h = step_of_shortening(c) / std::max(std::abs(shortening) / c.free_length, 0.01);
  const double slope =
      slope_of([&](double x) { return column_response(c.column, x, shortening).energy; }, c.free_length, h);
  const ColumnResponse r = response(c, shortening);
  RC_ASSERT(std::abs(slope - r.configurational_force) < 2e-6 * (c.euler + std::abs(r.load)));
}

RC_GTEST_PROP(ColumnProperty, stiffness_is_the_slope_of_the_load, ()) {
  const Case c = any_case(false);
  const double shortening = any_shortening(c);
  const double h = step_of_shortening(c);
  const double slope = slope_of([&](double x) { return response(c, x).load; }, shortening, h);
  const double bar = c.column.axial_rigidity / c.free_length;
  RC_ASSERT(std::abs(slope - response(c, shortening).stiffness) < 1e-5 * bar);
}

// A spring in series, of any stiffness beside the column's: both carry one load and share the way.
RC_GTEST_PROP(ColumnProperty, grip_that_gives_way_carries_the_same_load, ()) {
  const Case c = any_case(true);
  // Up to where every support's load still rises: beyond, a soft grip has more than one balance.
  const double shortening = *rc::gen::inRange(0, 2) == 0 ? any_between(-2.0, 4.0) * c.buckling_shortening
                                                         : any_between(-0.001, 0.4) * c.free_length;
  const double load = response(c, shortening).load;
  const double compliance = any_of_any_size(1e-6, 1.0) * c.free_length / c.euler;
  const ColumnResponse held =
      column_response(c.column, c.free_length, shortening + load * compliance, compliance);
  RC_ASSERT(std::abs(held.load - load) < 1e-9 * (c.euler + std::abs(load)));
  RC_ASSERT(std::abs(held.energy - response(c, shortening).energy) <=
            1e-8 * (c.euler * c.free_length + std::abs(held.energy)));
}

// Bow and compression add up to the shortening that was asked for: the equation is solved.
RC_GTEST_PROP(ColumnProperty, bow_and_compression_add_up_to_the_shortening, ()) {
  const Case c = any_case(true);
  const double shortening = any_shortening(c);
  const ColumnResponse r = response(c, shortening);
  const double sum = r.shortening_ratio * c.free_length + r.load * c.free_length / c.column.axial_rigidity;
  RC_ASSERT(std::abs(sum - shortening) < 1e-12 * c.free_length);
}

RC_GTEST_PROP(ColumnProperty, load_and_bow_grow_with_shortening_up_to_the_largest_load, ()) {
  const Case c = any_case(true);
  const double a = any_shortening(c);
  const double b = a + any_of_any_size(1e-4, 1e3) * c.buckling_shortening;
  const ColumnResponse less = response(c, a);
  const ColumnResponse more = response(c, b);
  RC_ASSERT(more.shortening_ratio >= less.shortening_ratio);
  RC_ASSERT(more.bow >= less.bow || c.column.support == Support::clamped_pinned ||
            more.shortening_ratio > 0.5);
  const bool before_maximum = c.column.support != Support::clamped_pinned || more.shortening_ratio < 0.44;
  if (before_maximum) RC_ASSERT(more.load >= less.load - 1e-11 * c.euler);
}

RC_GTEST_PROP(ColumnProperty, answer_is_finite_and_continuous_everywhere, ()) {
  const Case c = any_case(true);
  const double shortening = any_between(-1.0, 2.0) * c.free_length;
  const ColumnResponse r = response(c, shortening);
  for (double v : {r.load, r.stiffness, r.configurational_force, r.energy, r.bow, r.shortening_ratio})
    RC_ASSERT(std::isfinite(v));
  RC_ASSERT(r.energy >= -1e-15);
  RC_ASSERT(r.bow >= 0.0);
  // The load never changes faster than that of the bar.
  const double near = c.buckling_shortening * any_between(0.9, 1.1);
  const double step = 1e-6 * c.buckling_shortening;
  const double jump = std::abs(response(c, near + step).load - response(c, near).load);
  RC_ASSERT(jump <= 1.0001e-6 * c.euler + 1e-11 * c.euler);
}

}  // namespace
