#include "acus/sim/coupled_solve.h"

#include <algorithm>
#include <cmath>

#include "acus/numeric/root.h"
#include "acus/sim/tissue_step.h"

namespace acus {
namespace {

using coupling::Grip;
using numeric::NodeVector;

constexpr int max_passes = 12;  // branch corrections; two or three are usual
constexpr int easy_passes = 4;
constexpr double rate_resolution = 1e-12;  // m/s: slower is at rest
constexpr double finest_influence = 1e-5;  // relative residual of y: floats go no further

// y += times h sum over sticking points of rate_j h W_j^T a (W_j a . x): their springs act within the step.
template <class Real>
void add_sticks(numeric::NodeVectorOf<Real>& y, const Model& m, const Scratch& w,
                const numeric::NodeVectorOf<Real>& x, double times = 1.0) {
  const double h = m.scene.run.time_step;
  for (const HeldPoint& p : w.held) {
    if (p.grip != Grip::stick) continue;
    const double rate = coupling::force_on(p.slider, p.grip).rate * h * h;
    coupling::add_along(y, *p.at, times * rate * coupling::along(*p.at, x, m.path.direction),
                        m.path.direction);
  }
}

// y = A x, sticking points included, in the precision of the vectors.
struct Product {
  const Model& m;
  Scratch& w;
  template <class Real>
  void operator()(numeric::NodeVectorOf<Real>& y, const numeric::NodeVectorOf<Real>& x) const {
    multiply_tissue(y, m, w, x);
    add_sticks(y, m, w, x);
  }
};

// Single precision will do for y, which carries small corrections only; what it leaves a pass checks.
numeric::SolveOutcome solve_influence(numeric::NodeVectorOf<float>& y, const Model& m, Scratch& w,
                                      double tolerance) {
  const double norm = std::sqrt(numeric::dot(w.stick_load, w.stick_load, w.team));
  if (norm == 0.0) {  // everything slips: the tissue does not feel the needle's rate
    std::fill(y.begin(), y.end(), 0.0F);
    std::fill(w.solver.single.residual.begin(), w.solver.single.residual.end(), 0.0F);
    return {};
  }
  return numeric::solve_into(y, w.stick_load, tolerance * norm, max_iterations, w.solver.single,
                             Product{m, w}, preconditioner(m, w), w.team);
}

// What the held points do to the needle, as a function of its rate w about `guess`:
// constant + rate * w, tissue included through the influence y.
struct Reaction {
  double constant = 0.0;  // N
  double rate = 0.0;      // N s/m
};

Reaction gather_reaction(const Model& m, const State& s, const Scratch& w, double guess) {
  const double h = m.scene.run.time_step;
  Reaction r;
  for (const HeldPoint& p : w.held) {
    const coupling::LinearForce f = coupling::force_on(p.slider, p.grip);
    r.constant += f.constant;
    if (f.rate == 0.0) continue;
    const double tissue = coupling::along(*p.at, s.velocity, m.path.direction);
    const double answer = coupling::along(*p.at, s.influence, m.path.direction);
    r.constant += f.rate * h * (guess * answer - tissue);
    r.rate += f.rate * h * (1.0 - answer);
  }
  return r;
}

// The needle's rate at which column, reaction and configurational force balance.
double balanced_rate(const Model& m, const State& s, const Reaction& r, double hand_travel,
                     double free_length, double configurational_force, double guess) {
  const double h = m.scene.run.time_step;
  const auto imbalance = [&](double rate) {
    const double taken_up = hand_travel - s.tip_position - h * rate;
    return r.constant + r.rate * rate + configurational_force - column_load(m, free_length, taken_up);
  };
  double width = 1e-5;  // m/s, grows until it brackets the root: the imbalance rises with the rate
  // m/s. Where everything slips there may be no balance, because a folding column's load is bounded: then the
  // needle goes as far as this, the grips change, and the line search takes it back.
  constexpr double fastest = 1e3;
  double low = guess, high = guess;
  while (imbalance(low) > 0.0) {
    if (width > fastest) return low;
    low -= (width *= 4.0);
  }
  while (imbalance(high) < 0.0) {
    if (width > fastest) return high;
    high += (width *= 4.0);
  }
  return numeric::bracketed_root(imbalance, low, high, rate_resolution);
}

// Every point's branch for the present rates. Returns whether any changed.
bool correct_grips(const Model& m, const State& s, Scratch& w, double rate) {
  bool changed = false;
  for (HeldPoint& p : w.held) {
    const Grip grip = coupling::grip_after(p.slider, m.scene.run.time_step * (rate - tissue_rate(m, s, p)));
    changed = changed || grip != p.grip;
    p.grip = grip;
  }
  return changed;
}

// load += times what the held points do to resting tissue.
void add_held(NodeVector& load, const Model& m, const Scratch& w, double rate, double times) {
  const double h = m.scene.run.time_step;
  for (const HeldPoint& p : w.held) {
    const coupling::LinearForce f = coupling::force_on(p.slider, p.grip);
    coupling::add_along(load, *p.at, times * h * (f.constant + f.rate * h * rate), m.path.direction);
  }
}

void load_sticks(const Model& m, Scratch& w) {
  const double h = m.scene.run.time_step;
  std::fill(w.stick_load.begin(), w.stick_load.end(), 0.0F);
  for (const HeldPoint& p : w.held) {
    const double rate = coupling::force_on(p.slider, p.grip).rate;
    if (rate != 0.0) coupling::add_along(w.stick_load, *p.at, h * h * rate, m.path.direction);
  }
}

// The velocities at which the held points at `rate` and the tissue agree, and what they leave of the tissue's
// own equation.
numeric::SolveOutcome solve_tissue(const Model& m, State& s, Scratch& w, double rate, double exactness,
                                   double& target, const StepProbe& probe) {
  double load = 0.0;
  for (const HeldPoint& p : w.held)
    load +=
        std::abs(coupling::advance(p.slider, m.scene.run.time_step * (rate - tissue_rate(m, s, p))).force);
  numeric::copy_into(w.change, w.momentum, w.team);
  add_held(w.change, m, w, rate, 1.0);
  target = exactness * residual_target(m, w, w.change, load);
  add_held(w.imbalance, m, w, rate, 1.0);
  add_sticks(w.imbalance, m, w, s.velocity, -1.0);
  probe(StepPart::coupling);
  const numeric::SolveOutcome outcome = improve_velocity(m, s, w, target, Product{m, w});
  probe(StepPart::solve);
  add_held(w.imbalance, m, w, rate, -1.0);
  add_sticks(w.imbalance, m, w, s.velocity);
  return outcome;
}

// Lets the tissue follow a change of the needle's rate by its answer y. What is left of y's equation stands
// in `solver`: A y = loads - sticks - that.
void follow(const Model& m, State& s, Scratch& w, double change) {
  numeric::add_scaled_into(s.velocity, change, s.influence, w.team);
  numeric::NodeVectorOf<float>& product = w.solver.single.residual;
  numeric::scale_and_add_into(product, -1.0, w.stick_load, w.team);
  add_sticks(product, m, w, s.influence, -1.0);
  numeric::add_scaled_into(w.imbalance, -change, product, w.team);
}

// How far to go from (velocity_tried, rate_before) towards (velocity, rate): the root in (0, 1] of the
// incremental potential's slope, which rises along the way; 1 when it is still falling there.
double line_search(const Model& m, const State& s, Scratch& w, double hand_travel, double free_length,
                   double configurational_force, double rate_before, double rate) {
  const double h = m.scene.run.time_step;
  for (HeldPoint& p : w.held) {
    p.rate_before = coupling::along(*p.at, w.velocity_tried, m.path.direction);
    p.rate_change = tissue_rate(m, s, p) - p.rate_before;
  }
  NodeVector& change = w.change;
  numeric::copy_into(change, s.velocity, w.team);
  numeric::add_scaled_into(change, -1.0, w.velocity_tried, w.team);
  const double slope_at_start = -numeric::dot(change, w.imbalance_tried, w.team);
  const double curvature = -slope_at_start - numeric::dot(change, w.imbalance, w.team);
  const double rate_change = rate - rate_before;
  const auto slope = [&](double t) {
    const double r = rate_before + t * rate_change;
    double sum = slope_at_start + t * curvature;
    for (const HeldPoint& p : w.held) {
      const double sliding = h * (r - p.rate_before - t * p.rate_change);
      sum += h * coupling::advance(p.slider, sliding).force * (rate_change - p.rate_change);
    }
    const double load = column_load(m, free_length, hand_travel - s.tip_position - h * r);
    return sum + rate_change * h * (configurational_force - load);
  };
  if (slope(1.0) <= 0.0 || slope(0.0) >= 0.0) return 1.0;
  constexpr double resolution = 1e-9;
  return numeric::bracketed_root(slope, 0.0, 1.0, resolution);
}

}  // namespace

double column_load(const Model& m, double free_length, double taken_up) {
  return needle::column_response(m.column, free_length, taken_up, m.grip_compliance).load;
}

double tissue_rate(const Model& m, const State& s, const HeldPoint& point) {
  return coupling::along(*point.at, s.velocity, m.path.direction);
}

double resistance(const Model& m, Scratch& w) {
  constexpr double tolerance = 1e-3;  // of y; what it leaves of the residual is put right below
  const numeric::SolveOutcome outcome = solve_influence(w.answer, m, w, tolerance);
  if (outcome.broke_down || outcome.iterations >= max_iterations) return 0.0;
  // sum_j rate_j h (1 - W_j y), with b . y + r . y for b . y, whose error is of second order in that of y.
  const double h = m.scene.run.time_step;
  double all_stick = 0.0;
  for (const HeldPoint& p : w.held) all_stick += coupling::force_on(p.slider, p.grip).rate * h;
  const double followed =
      numeric::dot(w.stick_load, w.answer, w.team) + numeric::dot(w.solver.single.residual, w.answer, w.team);
  return std::max(all_stick - followed / h, 0.0);
}

CoupledOutcome solve_coupled(const Model& m, State& s, Scratch& w, double hand_travel, double free_length,
                             double configurational_force, const StepProbe& probe) {
  CoupledOutcome outcome;
  double rate = s.tip_rate;
  correct_grips(m, s, w, rate);
  double influence_tolerance = 0.1, exactness = 1.0;
  for (int pass = 0; pass < max_passes; ++pass) {
    numeric::copy_into(w.velocity_tried, s.velocity, w.team);
    numeric::copy_into(w.imbalance_tried, w.imbalance, w.team);
    // Points on the verge of slipping change for ever on solutions that are too rough to tell.
    if (pass >= easy_passes) exactness *= 0.1;
    double target = 0.0;
    const numeric::SolveOutcome solve = solve_tissue(m, s, w, rate, exactness, target, probe);
    load_sticks(m, w);
    probe(StepPart::coupling);
    numeric::SolveOutcome answer = solve_influence(s.influence, m, w, influence_tolerance);
    outcome.iterations += solve.iterations + answer.iterations;
    Reaction reaction = gather_reaction(m, s, w, rate);
    // The tissue never follows faster than the needle goes: a y that says so is too rough.
    while (reaction.rate < 0.0 && !answer.broke_down && influence_tolerance > finest_influence) {
      influence_tolerance = std::max(1e-2 * influence_tolerance, finest_influence);
      answer = solve_influence(s.influence, m, w, influence_tolerance);
      outcome.iterations += answer.iterations;
      reaction = gather_reaction(m, s, w, rate);
    }
    probe(StepPart::solve);
    outcome.broke_down = solve.broke_down || answer.broke_down || answer.iterations >= max_iterations;
    if (outcome.broke_down) return outcome;

    const double guess = rate;
    rate = balanced_rate(m, s, reaction, hand_travel, free_length, configurational_force, guess);
    probe(StepPart::rod);
    follow(m, s, w, rate - guess);
    if (correct_grips(m, s, w, rate)) {
      const double t = line_search(m, s, w, hand_travel, free_length, configurational_force, guess, rate);
      if (t < 1.0) {
        numeric::scale_and_add_into(s.velocity, t, w.velocity_tried, w.team);
        numeric::add_scaled_into(s.velocity, -t, w.velocity_tried, w.team);
        numeric::scale_and_add_into(w.imbalance, t, w.imbalance_tried, w.team);
        numeric::add_scaled_into(w.imbalance, -t, w.imbalance_tried, w.team);
        rate = guess + t * (rate - guess);
        correct_grips(m, s, w, rate);
      }
      continue;
    }
    // Correcting the rate through an inexact y leaves this much of a residual; where all is at rest there is
    // nothing to measure it by.
    const double correction = std::abs(rate - guess);
    if (correction <= rate_resolution || correction * answer.residual_norm <= target) {
      s.tip_rate = rate;
      return outcome;
    }
    influence_tolerance = std::max(1e-2 * influence_tolerance, finest_influence);
  }
  outcome.broke_down = true;
  return outcome;
}

}  // namespace acus
