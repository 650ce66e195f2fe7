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

}  // namespace

void decide_stage(State& s, const Observed& o, Frame& frame, std::vector<Event>& events) {
  const auto happened = [&](EventKind kind) {
    if (events.size() < events.capacity())
      events.push_back({frame.time, kind, frame.hand_travel, frame.hand_force, frame.free_length});
  };
  const Stage before = frame.stage;
  if (before == Stage::free && o.tip_force > 0.0) happened(EventKind::contact);
  if (!s.buckled && (o.column_load >= o.critical_load || o.bow_ratio >= bent)) {
    s.buckled = true;
    happened(s.punctured && !o.ruptured_now ? EventKind::second_buckling : EventKind::buckling);
  } else if (s.buckled && o.column_load < straight_again * o.critical_load && o.bow_ratio < 0.5 * bent) {
    s.buckled = false;
    happened(EventKind::straightening);
  }
  if (o.ruptured_now) happened(EventKind::puncture);
  frame.stage = stage_of(s, o);
  if (o.through_now || (frame.stage == Stage::withdrawn && before != Stage::withdrawn))
    happened(EventKind::exit);
}

}  // namespace acus
