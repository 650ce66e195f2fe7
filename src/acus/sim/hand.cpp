#include "acus/sim/hand.h"

#include <algorithm>

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

double hand_travel(const HandScene& hand, double time) {
  if (hand.kind == HandKind::path) return travel_along(hand.path, time);
  return std::clamp(hand.speed * time, 0.0, hand.travel);
}

double duration(const HandScene& hand) {
  if (hand.kind == HandKind::path) return hand.path.empty() ? 0.0 : hand.path.back().time;
  return hand.travel / hand.speed;
}

double furthest_travel(const HandScene& hand) {
  if (hand.kind == HandKind::steady) return hand.travel;
  double furthest = 0.0;
  for (const HandPoint& point : hand.path) furthest = std::max(furthest, point.travel);
  return furthest;
}

double grip_compliance(const HandScene& hand) { return hand.stiffness > 0.0 ? 1.0 / hand.stiffness : 0.0; }

}  // namespace acus
