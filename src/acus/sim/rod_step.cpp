#include "acus/sim/rod_step.h"

#include <cmath>

#include "acus/needle/buckling.h"
#include "acus/sim/rod_contact.h"
#include "acus/sim/rod_solve.h"
#include "acus/sim/stage.h"
#include "acus/sim/tissue_step.h"

namespace acus {
namespace {

// What the end of a step must know of its beginning.
struct Before {
  TissueBefore tissue;
  Vec3 hub{0.0, 0.0, 0.0};      // m, node 0
  double rod_energy = 0.0;      // J
};

// Rod's lines of the ledger, exact identities of implicit Euler: what its forces at the end do over the step, less what its energy
// has changed by, is lost, and so is the inertia of the change of rate.
void account_rod(const Model& m, State& s, const Scratch& w, const Before& before, const Vec3& hub_force) {
  const needle::RodMotion& motion = w.rod.motion;
  const double h = m.scene.run.time_step;
  double elastic_work = 0.0, lost_inertia = 0.0;
  for (int i = 0; i < m.rod.unknowns(); ++i) {
    elastic_work += h * motion.force[i] * s.needle.rod.rate[i];
    const double change = s.needle.rod.rate[i] - motion.rate_before[i];
    lost_inertia += 0.5 * needle::inertia(m.rod, i) * change * change;
  }
  const double energy = needle::total(motion.energy);
  s.ledger.work_numerical += lost_inertia - elastic_work - (energy - before.rod_energy);
  s.ledger.energy_needle = energy;
  s.ledger.energy_kinetic += 0.5 * needle::inertia_product(m.rod, s.needle.rod.rate);
  s.ledger.work_hand += hub_force.dot(s.needle.rod.position[0] - before.hub);
}

Health health_of(const Model& m, const State& s, const RodPlace& place) {
  if (!std::isfinite(force::accounted(s.ledger))) return Health::not_finite;
  return place.free_length < needle::shortest_column * m.scene.needle.radius ? Health::hub_at_entry : Health::good;
}

}  // namespace

void advance_rod(const Model& m, State& s, Scratch& w, const needle::Pose& hub, double hand_travel, Frame& frame,
                 std::vector<Event>& events, const StepProbe& probe) {
  Before before;
  before.tissue.energy = w.corotation.energy;
  before.hub = s.needle.rod.position[0];
  before.rod_energy = s.ledger.energy_needle;
  touch_rod(m, s, w);
  probe(StepPart::touch);
  if (!m.rigid()) {
    assemble_tissue(m, s, w);
    begin_tissue(s, w);
  }
  probe(StepPart::assembly);
  const RodOutcome solved = solve_with_rod(m, s, w, hub);
  if (solved.broke_down) {
    frame.health = Health::solver_broke_down;
    return;
  }
  frame.solver_iterations = solved.iterations;
  probe(StepPart::solve);
  if (!m.rigid()) {
    move_tissue(m, s, w, before.tissue, probe);
    account_tissue(m, s, w, before.tissue);
  } else {
    s.ledger.energy_kinetic = 0.0;
  }
  const coupling::SliderStep tip = slide_rod(m, s, w);
  Observed observed;
  observed.tip_force = tip.force;
  observed.ruptured_now = !s.punctured && tip.slip > 0.0;
  s.punctured = s.punctured || observed.ruptured_now;
  observed.through_now = cut_along_tip(m, s, tip.slip);
  probe(StepPart::cutting);
  account_rod(m, s, w, before, solved.hub_force);

  ++s.steps;
  frame.time = static_cast<double>(s.steps) * m.scene.run.time_step;
  const Vec3& along = m.path.direction;
  s.hub_travel = hand_travel + along.dot(s.needle.rod.position[0] - hub.position);
  s.tip_position = along.dot(s.needle.rod.position.back() - m.path.entry);
  const RodPlace place = place_rod(m, s);
  observed.column_load = solved.hub_force.dot(along);
  observed.critical_load = needle::critical_load(needle::bending_rigidity(m.scene.needle), place.free_length, m.scene.needle.support);
  observed.bow_ratio = place.bow / place.free_length;
  observed.inserted_length = place.inserted_length;
  frame.hand_travel = s.hub_travel;
  frame.hand_force = observed.column_load;
  frame.tip_force = observed.tip_force;
  frame.tip_depth = s.tip_position;
  frame.inserted_length = place.inserted_length;
  frame.free_length = place.free_length;
  frame.critical_load = observed.critical_load;
  frame.deflection = place.bow;
  frame.ledger = s.ledger;
  frame.energy_residual = force::residual(s.ledger);
  frame.energy_force = s.energy_force.after(s.hub_travel, force::accounted(s.ledger));
  decide_stage(s, observed, frame, events);
  frame.health = health_of(m, s, place);
  probe(StepPart::ledger);
}

}  // namespace acus
