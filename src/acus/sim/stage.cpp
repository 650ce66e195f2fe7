#include "acus/sim/stage.h"

namespace acus {
namespace {

Stage stage_of(const State& s, const Observed& o) {
  if (!s.punctured) {
    if (s.buckled) return Stage::buckled;
    return o.tip_force > 0.0 ? Stage::contact : Stage::free;
  }
  if (o.inserted_length <= 0.0 && o.tip_force <= 0.0) return Stage::withdrawn;
  return s.buckled ? Stage::inserted_buckled : Stage::inserted;
}

void decide_stage(State& s, const Observed& o, Frame& frame, std::vector<Event>& events) {
  const auto happened = [&](EventKind kind) {
    if (events.size() < events.capacity())
      events.push_back({frame.time, kind, frame.hand_travel, frame.hand_force, frame.free_length});
  };
  const Stage before = frame.stage;
  if (before == Stage::free && o.tip_force > 0.0) happened(EventKind::contact);
  if (!s.buckled && o.bent == Bent::yes) {
    s.buckled = true;
    happened(s.punctured && !o.ruptured_now ? EventKind::second_buckling : EventKind::buckling);
  } else if (s.buckled && o.bent == Bent::no) {
    s.buckled = false;
    happened(EventKind::straightening);
  }
  if (o.ruptured_now) happened(EventKind::puncture);
  frame.stage = stage_of(s, o);
  if (o.through_now || (frame.stage == Stage::withdrawn && before != Stage::withdrawn))
    happened(EventKind::exit);
}

}  // namespace

Bent column_bent(double load, double critical_load, double bow_ratio) {
  constexpr double straight_again = 0.9;
  if (load >= critical_load || bow_ratio >= bent_ratio) return Bent::yes;
  return load < straight_again * critical_load && bow_ratio < straight_ratio ? Bent::no : Bent::in_between;
}

Bent rod_bent(double bow_ratio, double time_straight, double period) {
  if (bow_ratio >= bent_ratio) return Bent::yes;
  return time_straight > period ? Bent::no : Bent::in_between;
}

void show(const Model& m, State& s, const Observed& o, Frame& frame, std::vector<Event>& events) {
  frame.time = static_cast<double>(s.steps) * m.scene.run.time_step;
  frame.hand_travel = s.hub_travel;
  frame.hand_force = o.hand_force;
  frame.tip_force = o.tip_force;
  frame.shaft_force = o.shaft_force;
  frame.tip_depth = s.tip_position;
  frame.tip_aside = o.tip_aside;
  frame.inserted_length = o.inserted_length;
  frame.free_length = o.free_length;
  frame.critical_load = o.critical_load;
  frame.deflection = o.bow;
  frame.ledger = s.ledger;
  frame.energy_residual = force::residual(s.ledger);
  frame.energy_force = s.energy_force.after(s.hub_travel, force::accounted(s.ledger));
  decide_stage(s, o, frame, events);
}

}  // namespace acus
