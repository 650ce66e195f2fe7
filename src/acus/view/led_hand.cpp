#include "acus/view/led_hand.h"

#include <algorithm>

#include "acus/sim/hand.h"
#include "acus/sim/support.h"

namespace acus::view {

LedHand::LedHand(const Scene& scene)
    : least_(-in_front_of_hand(scene).length),
      most_(in_front_of_hand(scene).length - needle::shortest_column * scene.needle.radius),
      fastest_(5.0 * scene.hand.speed),  // of docs/studio-protocol.md: quick, but not a jump
      travel_(start_travel(scene.hand)) {}

void LedHand::push(double travel) {
  pushed_ = true;
  target_ = std::clamp(travel, least_, most_);
}

void LedHand::steady(double speed) {
  pushed_ = false;
  speed_ = speed;
}

double LedHand::advance(double time_step) {
  const double farthest = fastest_ * time_step;
  const double wanted = pushed_ ? std::clamp(target_ - travel_, -farthest, farthest) : speed_ * time_step;
  // A scene's own hand may begin further out than this one may pull.
  travel_ = std::clamp(travel_ + wanted, std::min(least_, travel_), most_);
  return travel_;
}

}  // namespace acus::view
