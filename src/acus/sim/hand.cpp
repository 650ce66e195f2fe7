#include "acus/sim/hand.h"

#include <algorithm>
#include <cmath>

#include "acus/sim/tremor.h"

namespace acus {
namespace {

double travel_along(const std::vector<HandPoint>& path, double time) {
  const auto after = std::upper_bound(path.begin(), path.end(), time,
                                      [](double t, const HandPoint& point) { return t < point.time; });
  if (after == path.begin()) return path.empty() ? 0.0 : path.front().travel;
  if (after == path.end()) return path.back().travel;
  const HandPoint& from = *(after - 1);
  const double share = (time - from.time) / (after->time - from.time);
  return from.travel + share * (after->travel - from.travel);
}

}  // namespace

std::optional<double> Hand::next(double force) {
  if (scene_.kind == HandKind::person) {
    if (person_.doing == Person::Doing::nothing_more) return std::nullopt;
    person_ = person_after(person_, scene_, force, time_step_);
    return person_.travel;
  }
  if (steps_ >= step_count(scene_, time_step_)) return std::nullopt;
  return planned_travel(scene_, ++steps_ * time_step_);
}

double start_travel(const HandScene& hand) {
  return hand.kind == HandKind::person ? Person{}.travel : planned_travel(hand, 0.0);
}

double planned_travel(const HandScene& hand, double time) {
  if (hand.kind == HandKind::path) return travel_along(hand.path, time);
  return std::clamp(hand.speed * time, 0.0, hand.travel);
}

double duration(const HandScene& hand) {
  if (hand.kind == HandKind::path) return hand.path.empty() ? 0.0 : hand.path.back().time;
  return hand.kind == HandKind::person ? longest_trial(hand) : hand.travel / hand.speed;
}

int step_count(const HandScene& hand, double time_step) {
  constexpr double rounding = 1e-9;  // of a step: a duration of 8.0 s is 8000 steps of 1 ms, not 8001
  return static_cast<int>(std::ceil(duration(hand) / time_step - rounding));
}

double furthest_travel(const HandScene& hand) {
  if (hand.kind == HandKind::steady) return hand.travel;
  if (hand.kind == HandKind::person) return hand.travel + furthest_tremor(hand.tremor);
  double furthest = 0.0;
  for (const HandPoint& point : hand.path) furthest = std::max(furthest, point.travel);
  return furthest;
}

double grip_compliance(const HandScene& hand) { return hand.stiffness > 0.0 ? 1.0 / hand.stiffness : 0.0; }

}  // namespace acus
