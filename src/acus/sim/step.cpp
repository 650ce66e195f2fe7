#include "acus/sim/step.h"

#include <algorithm>
#include <cmath>

#include "acus/sim/stage.h"
#include "acus/sim/support.h"
#include "acus/sim/tissue_step.h"

namespace acus {
namespace {

// What the end of a step must know of its beginning.
struct Before {
  NeedlePlace place;
  needle::ColumnResponse column;
  double hub_travel = 0.0;  // m
  TissueBefore tissue;

  // Q, against the needle and into the tissue at the entry: sliding in bends the free part further. N
  double configurational_force(const Model& m) const {
    return place.free_length < m.needle.length ? -column.configurational_force : 0.0;
  }
};

Before remember(const Model& m, const State& s, const Scratch& w) {
  Before before;
  before.place = place_needle(m, s);
  before.column = needle::column_response(m.column, before.place.free_length, before.place.shortening);
  before.hub_travel = s.hub_travel;
  before.tissue.energy = w.corotation.energy;
  return before;
}

// The needle over its channel, and everything that can hold it there.
void touch(const Model& m, State& s, Scratch& w, const NeedlePlace& place) {
  s.ledger.work_friction += coupling::cover(s.channel, m.channel, place.covered_depth, place.inserted_length);
  w.held.clear();
  w.held.push_back({tip_slider(m, s), &s.tip, -1});
  for (int cell = 0; cell < m.channel.cells(); ++cell)
    if (s.channel.length[cell] > 0.0)
      w.held.push_back({coupling::slider_of(m.channel, s.channel, cell), &m.channel.attachment[cell], cell});
}

// Carries out the sliders' steps and books what they spent. Returns the tip's.
coupling::NeedleSlide slide(const Model& m, State& s, const Scratch& w) {
  const double h = m.scene.run.time_step;
  coupling::NeedleSlide all;
  for (const HeldPoint& p : w.held) {
    const coupling::SliderStep step = coupling::advance(p.slider, h * (s.tip_rate - tissue_rate(m, s, p)));
    s.ledger.work_numerical += step.numerical;
    s.ledger.work_damping += step.released;
    if (p.cell < 0) {
      s.tip_elongation = step.elongation;
      s.ledger.work_cutting += step.dissipated;
      all.tip = step;
    } else {
      all.shaft_force += step.force;
      s.channel.elongation[p.cell] = step.elongation;
      s.ledger.work_friction += step.dissipated;
    }
  }
  return all;
}

double contact_energy(const Model& m, const State& s) {
  double energy = coupling::stored_energy(tip_slider(m, s), s.tip_elongation);
  for (int cell = 0; cell < m.channel.cells(); ++cell)
    energy +=
        coupling::stored_energy(coupling::slider_of(m.channel, s.channel, cell), s.channel.elongation[cell]);
  return energy;
}

// The cut goes on to where the tip has come: the rest depth l with l + u(l) = tip - squeeze of the contact
// spring. Returns whether it has come out at the far side.
bool cut(const Model& m, State& s, double slip) {
  if (slip <= 0.0 || s.through) return false;
  const double from = s.channel_depth;
  const auto present = [&](double depth) {
    return depth + coupling::displacement_along(s.tip, s.position, m.mesh.nodes, m.path.direction);
  };
  const double wanted = s.tip_position - s.tip_elongation;
  const double present_from = present(from);
  attach_tip_into(s.tip, m, std::min(from + slip, m.path.length));
  const double present_try = present(from + slip);
  // Stretch of the path under the tip. Bounded, as is the advance, so that a crumpled element or a jump to
  // another nearest node cannot throw the cut far ahead in one step; the next step makes up for what is
  // missing.
  constexpr double least_stretch = 0.2, most_stretch = 5.0;
  const double stretch = std::clamp((present_try - present_from) / slip, least_stretch, most_stretch);
  const double advance = std::clamp(slip + (wanted - present_try) / stretch, 0.0, slip / least_stretch);
  s.channel_depth = from + advance;
  if (s.channel_depth >= m.path.length) {
    s.through = true;
    s.channel_depth = m.path.length;
    s.ledger.work_numerical += 0.5 * m.tip_stiffness * s.tip_elongation * s.tip_elongation;
    s.tip_elongation = 0.0;  // the contact spring lets go
  }
  attach_tip_into(s.tip, m, s.channel_depth);
  return s.through;
}

// Lines of contact and entry.
void account_contact(const Model& m, State& s, const Before& before) {
  s.ledger.energy_contact = contact_energy(m, s);
  // The entry's force on a free part that shortens while it holds the shortening: energy of the bow.
  const double gone_in =
      m.scene.run.time_step * (s.tip_rate - coupling::along(m.entry, s.velocity, m.path.direction));
  s.ledger.work_snap += before.configurational_force(m) * gone_in;
}

// Needle's lines: the hand's force times its travel, less what the tip took on, bends and compresses the free
// part.
void account_needle(const Model& m, State& s, const Before& before, double hand_force, double needle_energy) {
  const double hub_step = s.hub_travel - before.hub_travel;
  const double tip_step = m.scene.run.time_step * s.tip_rate;
  s.ledger.work_hand += hand_force * hub_step;
  s.ledger.work_snap += hand_force * (hub_step - tip_step) - (needle_energy - before.column.energy);
  s.ledger.energy_needle = needle_energy;
}

Health health_of(const State& s, const needle::ColumnResponse& column, const NeedlePlace& place,
                 double radius) {
  if (!std::isfinite(s.tip_position) || !std::isfinite(force::accounted(s.ledger))) return Health::not_finite;
  if (column.folded) return Health::needle_folded;
  return place.free_length < needle::shortest_column * radius ? Health::hub_at_entry : Health::good;
}

// Needle and tissue to the end of the step. Returns whether the solve held.
bool move_together(const Model& m, State& s, Scratch& w, double hand_travel, Before& before, Frame& frame,
                   const StepProbe& probe) {
  const double h = m.scene.run.time_step;
  touch(m, s, w, before.place);
  probe(StepPart::contact);
  const double configurational = before.configurational_force(m);
  form_momentum(m, s, w);
  coupling::add_along(w.momentum, m.entry, h * configurational, m.path.direction);
  begin_tissue(m, s, w);
  probe(StepPart::assembly);
  const CoupledOutcome solved =
      solve_coupled(m, s, w, hand_travel, before.place.free_length, configurational, probe);
  if (solved.broke_down) return false;
  frame.solver_iterations = solved.iterations;
  probe(StepPart::coupling);
  s.tip_position += h * s.tip_rate;
  move_tissue(m, s, w, before.tissue, probe);
  return true;
}

}  // namespace

void advance(const Model& m, State& s, Scratch& w, double hand_travel, Frame& frame,
             std::vector<Event>& events, const StepProbe& probe) {
  Before before = remember(m, s, w);
  Observed observed;
  if (!m.rigid()) {
    if (!move_together(m, s, w, hand_travel, before, frame, probe)) {
      frame.health = Health::solver_broke_down;
      return;
    }
    const auto [tip, shaft_force] = slide(m, s, w);
    observed.tip_force = tip.force;
    observed.shaft_force = shaft_force;
    observed.ruptured_now = !s.punctured && tip.slip > 0.0;
    s.punctured = s.punctured || observed.ruptured_now;
    observed.through_now = cut(m, s, tip.slip);
    probe(StepPart::cutting);
    account_tissue(m, s, w, before.tissue);
    account_contact(m, s, before);
  }
  ++s.steps;
  if (m.rigid()) s.tip_position = std::min(hand_travel, 0.0);  // the stop holds the tip only from one side
  observed.hand_force = column_load(m, before.place.free_length, hand_travel - s.tip_position);
  s.hub_travel = hand_travel - observed.hand_force * m.grip_compliance;
  if (m.rigid()) observed.tip_force = std::max(observed.hand_force, 0.0);
  const NeedlePlace place = place_needle(m, s);
  const needle::ColumnResponse column =
      needle::column_response(m.column, place.free_length, place.shortening);
  account_needle(m, s, before, observed.hand_force, column.energy);

  observed.inserted_length = place.inserted_length;
  observed.free_length = place.free_length;
  observed.bow = column.bow;
  observed.critical_load = critical_load(m.scene, place.free_length);
  observed.bent = column_bent(observed.hand_force, observed.critical_load, column.bow / place.free_length);
  frame.hub_force = observed.hand_force * m.path.direction;
  show(m, s, observed, frame, events);
  frame.health = health_of(s, column, place, m.scene.needle.radius);
  probe(StepPart::ledger);
}

}  // namespace acus
