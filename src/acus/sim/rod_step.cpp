#include "acus/sim/rod_step.h"

#include <algorithm>
#include <cmath>

#include "acus/numeric/circular.h"
#include "acus/sim/rod_contact.h"
#include "acus/sim/rod_solve.h"
#include "acus/sim/stage.h"
#include "acus/sim/support.h"
#include "acus/sim/tissue_step.h"

namespace acus {
namespace {

// What the end of a step must know of its beginning.
struct Before {
  TissueBefore tissue;
  Vec3 node{0.0, 0.0, 0.0};  // m, node 0
  needle::Pose hub;
  double rod_energy = 0.0;  // J
};

// rad, about the axis it points along: the turn from one pose to another, less than a right angle.
Vec3 turn_between(const needle::Pose& from, const needle::Pose& to) {
  const Vec3 sine = 0.5 * (from.tangent.cross(to.tangent) + from.director.cross(to.director) +
                           from.tangent.cross(from.director).cross(to.tangent.cross(to.director)));
  const double size = std::min(sine.norm(), 1.0);
  return size > 0.0 ? Vec3(numeric::asin(size) / size * sine) : sine;
}

// Rod's lines of the ledger, exact identities of implicit Euler: what its forces at the end do over the step,
// less what its energy has changed by, is lost, and so is the inertia of the change of rate.
void account_rod(const Model& m, State& s, const Scratch& w, const Before& before, const Frame& frame) {
  const needle::RodMotion& motion = w.rod.motion;
  const double h = m.scene.run.time_step;
  double elastic_work = 0.0, lost_inertia = 0.0;
  for (int i = 0; i < m.rod.unknowns(); ++i) {
    elastic_work += h * motion.force[i] * s.needle.rod.rate[i];
    const double change = s.needle.rod.rate[i] - motion.rate_before[i];
    lost_inertia += 0.5 * needle::inertia(m.rod, i) * change * change;
  }
  const double turning_work = frame.hub_moment.dot(turn_between(before.hub, s.needle.hub));
  elastic_work -= turning_work;
  const double energy = needle::total(motion.energy);
  s.ledger.work_numerical += lost_inertia - elastic_work - (energy - before.rod_energy);
  s.ledger.energy_needle = energy;
  s.ledger.energy_kinetic += 0.5 * needle::inertia_product(m.rod, s.needle.rod.rate);
  s.ledger.work_hand += frame.hub_force.dot(s.needle.rod.position[0] - before.node) + turning_work;
}

Bent bent_of(const Model& m, State& s, const RodPlace& place) {
  s.steps_straight = place.bow_ratio < straight_ratio ? s.steps_straight + 1 : 0;
  return rod_bent(place.bow_ratio, static_cast<double>(s.steps_straight) * m.scene.run.time_step,
                  needle::slowest_period(m.needle, place.span));
}

Health health_of(const Model& m, const State& s, const RodPlace& place) {
  if (!std::isfinite(force::accounted(s.ledger))) return Health::not_finite;
  // A joint lets the needle swing round until it lies on the hand; the rod's twist has no meaning there.
  constexpr double folded = -0.95;  // cosine
  if (s.needle.hub.tangent.dot(needle::edge(s.needle.rod, 0).normalized()) < folded)
    return Health::needle_folded;
  return place.free_length < needle::shortest_column * m.needle.radius ? Health::hub_at_entry : Health::good;
}

}  // namespace

void advance_rod(const Model& m, State& s, Scratch& w, const needle::Pose& hub, Frame& frame,
                 std::vector<Event>& events, const StepProbe& probe) {
  Before before;
  before.tissue.energy = w.corotation.energy;
  before.node = s.needle.rod.position[0];
  before.hub = s.needle.hub;
  before.rod_energy = s.ledger.energy_needle;
  touch_rod(m, s, w);
  probe(StepPart::contact);
  if (!m.rigid()) {
    form_momentum(m, s, w);
    begin_tissue(m, s, w);
  }
  probe(StepPart::assembly);
  const RodOutcome solved = solve_with_rod(m, s, w, hub, probe);
  if (solved.broke_down) {
    frame.health = Health::solver_broke_down;
    return;
  }
  frame.solver_iterations = solved.iterations;
  frame.hub_force = solved.hub_force;
  frame.hub_moment = needle::hub_moment(m.rod, s.needle.rod, hub);
  s.needle.hub = hub;
  probe(StepPart::rod);
  if (!m.rigid()) {
    move_tissue(m, s, w, before.tissue, probe);
    account_tissue(m, s, w, before.tissue);
    probe(StepPart::ledger);
  } else {
    s.ledger.energy_kinetic = 0.0;
  }
  const auto [tip, shaft_force] = slide_rod(m, s, w);
  Observed observed;
  observed.shaft_force = shaft_force;
  observed.tip_force = tip.force;
  observed.ruptured_now = !s.punctured && tip.slip > 0.0;
  s.punctured = s.punctured || observed.ruptured_now;
  observed.through_now = cut_along_tip(m, s, tip);
  probe(StepPart::cutting);
  account_rod(m, s, w, before, frame);

  ++s.steps;
  const Vec3& along = m.path.direction;
  s.hub_travel = along.dot(s.needle.rod.position[0] - m.path.entry) + m.needle.length;
  const Vec3 tip_from_entry = s.needle.rod.position.back() - m.path.entry;
  s.tip_position = along.dot(tip_from_entry);
  observed.tip_aside = along.cross(tip_from_entry).norm();
  const RodPlace place = place_rod(m, s);
  observed.hand_force = solved.hub_force.dot(along);
  observed.inserted_length = place.inserted_length;
  observed.free_length = place.free_length;
  observed.bow = place.bow;
  observed.critical_load = critical_load(m.scene, place.free_length);
  observed.bent = bent_of(m, s, place);
  show(m, s, observed, frame, events);
  frame.health = health_of(m, s, place);
  probe(StepPart::ledger);
}

}  // namespace acus
