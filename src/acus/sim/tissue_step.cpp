#include "acus/sim/tissue_step.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace acus {

namespace {

double persistence_of(double before, const numeric::NodeVector& now, const numeric::NodeVector& last,
                      const Team& team) {
  return persistence_after(before, numeric::dot(now, last, team), numeric::dot(last, last, team));
}

void note_change(State& s, Scratch& w) {
  numeric::NodeVector& change = w.velocity_before;
  numeric::scale_and_add_into(change, -1.0, s.velocity, w.team);
  s.change_persists = persistence_of(s.change_persists, change, s.velocity_change, w.team);
  numeric::NodeVector& bend = s.velocity_change;
  numeric::scale_and_add_into(bend, -1.0, change, w.team);
  s.bend_persists = persistence_of(s.bend_persists, bend, s.velocity_bend, w.team);
  std::swap(s.velocity_bend, bend);
  std::swap(s.velocity_change, change);
}

// On along a line and, where more than half of the bend came again, along a parabola: what solves leave over
// is in a bend twice as much as in a change.
void go_on(State& s, const Scratch& w) {
  numeric::add_scaled_into(s.velocity, s.change_persists, s.velocity_change, w.team);
  const double bend = s.change_persists * std::max(2.0 * s.bend_persists - 1.0, 0.0);
  if (bend > 0.0) numeric::add_scaled_into(s.velocity, bend, s.velocity_bend, w.team);
}

}  // namespace

bool single_precision_will_do(const Model& m) {
  const double nu = m.scene.tissue.poisson_ratio;
  const double bulk_over_shear = (1.0 + nu) / (1.5 - 3.0 * nu);
  const double least_tolerance = std::max(1e-6, 2e-8 * bulk_over_shear);
  return m.solver_tolerance() >= least_tolerance && m.scene.run.solver_precision == Precision::single_;
}

void multiply_tissue(numeric::NodeVectorOf<float>& y, const Model& m, Scratch& w,
                     const numeric::NodeVectorOf<float>& x) {
  tissue::multiply_into(y, m.tissue, w.corotation, w.matrix, x, w.team);
}

void multiply_tissue(numeric::NodeVector& y, const Model& m, Scratch& w, const numeric::NodeVector& x) {
  if (!w.corotation.is_single()) return tissue::multiply_into(y, m.tissue, w.corotation, w.matrix, x, w.team);
  numeric::NodeVectorOf<float>&single = w.solver.single.direction, &product = w.solver.single.product;
  numeric::scale_into(single, 1.0, x, w.team);
  multiply_tissue(product, m, w, single);
  numeric::scale_into(y, 1.0, product, w.team);
}

double persistence_after(double before, double again, double all) {
  constexpr double memory = 3.0;  // steps
  const double now = all > 0.0 ? std::clamp(again / all, 0.0, 1.0) : 0.0;
  return before + (now - before) / memory;
}

void form_momentum(const Model& m, const State& s, Scratch& w) {
  tissue::momentum_into(w.momentum, m.tissue, s.velocity, w.corotation.elastic_force, m.scene.run.time_step,
                        w.team);
}

void begin_tissue(const Model& m, State& s, Scratch& w) {
  numeric::copy_into(w.velocity_before, s.velocity, w.team);
  go_on(s, w);
  multiply_tissue(w.imbalance, m, w, s.velocity);
  numeric::scale_and_add_into(w.imbalance, -1.0, w.momentum, w.team);
}

numeric::SolveOutcome improve_in_double(
    const Model& m, State& s, Scratch& w, double target,
    const std::function<void(numeric::NodeVector&, const numeric::NodeVector&)>& multiply) {
  return numeric::improve_in_double_into(s.velocity, w.imbalance, target, max_iterations, w.exact_solver,
                                         w.solver.single, multiply, preconditioner(m, w), w.team);
}

double residual_target(const Model& m, const Scratch& w, const numeric::NodeVector& right_hand_side,
                       double load) {
  const double norm = std::sqrt(numeric::dot(right_hand_side, right_hand_side, w.team));
  return m.solver_tolerance() * (norm + m.scene.run.time_step * std::max(load, m.least_load));
}

void move_tissue(const Model& m, State& s, Scratch& w, TissueBefore& before, const StepProbe& probe) {
  const double h = m.scene.run.time_step;
  note_change(s, w);
  before.elastic_work =
      h * numeric::dot(std::span(w.corotation.elastic_force).first(s.velocity.size()), s.velocity, w.team);
  before.matrix_product =
      numeric::dot(s.velocity, w.momentum, w.team) - numeric::dot(s.velocity, w.imbalance, w.team);
  probe(StepPart::ledger);
  tissue::move(s.position, s.velocity, h, w.team);
  tissue::corotate_into(w.corotation, s.branch, m.tissue, s.position, w.team);
  probe(StepPart::rotation);
}

// With a Maxwell branch K' and f_el are those of elastic tissue and branch together (relaxation.h); so are
// the energies, and what its dashpots spend has a line of its own. Exact identities of linearly implicit
// Euler (motion.h): with K' frozen the elastic energy is quadratic, so its change is -f_el . dx + dx . K' dx
// / 2, and what the new rotations change is booked too.
void account_tissue(const Model& m, State& s, const Scratch& w, const TissueBefore& before) {
  const double h = m.scene.run.time_step;
  const double vmv = tissue::mass_product(m.tissue, s.velocity, w.team);
  const double vkv = (before.matrix_product - m.factors.mass * vmv) / m.factors.stiffness;
  const double frozen_energy = before.energy - before.elastic_work + 0.5 * h * h * vkv;
  s.ledger.work_damping += h * (m.damping.mass * vmv + m.damping.stiffness * vkv);
  s.ledger.work_numerical += 0.5 * tissue::mass_product(m.tissue, s.velocity_change, w.team) +
                             0.5 * h * h * vkv + (frozen_energy - w.corotation.energy) - w.corotation.relaxed;
  s.ledger.work_relaxation += w.corotation.relaxed;
  s.ledger.energy_tissue = w.corotation.energy;
  s.ledger.energy_kinetic = 0.5 * vmv;
}

}  // namespace acus
