#include "acus/sim/tissue_step.h"

#include <cmath>

namespace acus {

void assemble_tissue(const Model& m, const State& s, Scratch& w) {
  tissue::momentum_into(w.momentum, m.tissue, s.velocity, w.corotation.elastic_force, m.scene.run.time_step);
}

void begin_tissue(const Model& m, State& s, Scratch& w) {
  w.velocity_before = s.velocity;
  s.velocity = w.velocity_expected;
  tissue::imbalance_into(w.imbalance, m.tissue, m.factors, w.momentum, s.velocity, w.corotation.reaction);
}

double residual_target(const Model& m, const Scratch& w, double load) {
  const double momentum = std::sqrt(numeric::dot(w.right_hand_side, w.right_hand_side));
  return m.scene.run.solver_tolerance * (momentum + m.scene.run.time_step * load);
}

void move_tissue(const Model& m, State& s, Scratch& w, TissueBefore& before, const StepProbe& probe) {
  const double h = m.scene.run.time_step;
  numeric::learn(s.extrapolation, s.velocity, w.velocity_before);
  before.elastic_work =
      h * numeric::dot(std::span(w.corotation.elastic_force).first(s.velocity.size()), s.velocity);
  before.matrix_product = numeric::dot(s.velocity, w.momentum) - numeric::dot(s.velocity, w.imbalance);
  probe(StepPart::ledger);
  tissue::move(s.position, s.velocity, h);
  w.velocity_expected = s.velocity;
  numeric::extrapolate(w.velocity_expected, s.extrapolation);
  tissue::corotate_into(w.corotation, s.branch, m.tissue, s.position, w.velocity_expected);
  probe(StepPart::rotation);
}

// With a Maxwell branch K' and f_el are those of elastic tissue and branch together (relaxation.h); so are
// the energies, and what its dashpots spend has a line of its own. Exact identities of linearly implicit
// Euler (motion.h): with K' frozen the elastic energy is quadratic, so its change is -f_el . dx + dx . K' dx
// / 2, and what the new rotations change is booked too.
void account_tissue(const Model& m, State& s, const Scratch& w, const TissueBefore& before) {
  const double h = m.scene.run.time_step;
  const double vmv = tissue::mass_product(m.tissue, s.velocity);
  const double vkv = (before.matrix_product - m.factors.mass * vmv) / m.factors.stiffness;
  const double frozen_energy = before.energy - before.elastic_work + 0.5 * h * h * vkv;
  s.ledger.work_damping += h * (m.damping.mass * vmv + m.damping.stiffness * vkv);
  s.ledger.work_numerical += 0.5 * tissue::mass_product(m.tissue, s.extrapolation.difference[0]) +
                             0.5 * h * h * vkv + (frozen_energy - w.corotation.energy) - w.corotation.relaxed;
  s.ledger.work_relaxation += w.corotation.relaxed;
  s.ledger.energy_tissue = w.corotation.energy;
  s.ledger.energy_kinetic = 0.5 * vmv;
}

}  // namespace acus
