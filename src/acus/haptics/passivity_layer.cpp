#include "acus/haptics/passivity_layer.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace acus::haptics {
namespace {

// No number that comes in may spoil what comes after it: what no hand and no device does is not counted.
constexpr double strongest_force = 100.0;  // N
constexpr double top_speed = 2.0;          // m/s

}  // namespace

PassivityLayer::PassivityLayer(const DeviceLimits& limits, double stiffness, double period)
    : period_(period),
      quantum_(limits.quantum),
      stiffness_(stiffness),
      delay_time_(limits.delay),
      delay_(std::min(static_cast<std::size_t>(std::lround(limits.delay / period)), most_on_the_way - 1)) {}

void PassivityLayer::moved(double step, double told, bool held_between) noexcept {
  constexpr double recovery = 1e-3;  // W, chosen: half a second for what a bent needle holds
  lost_ = std::max(lost_ - recovery * period_, 0.0);
  newest_ = (newest_ + 1) % most_on_the_way;
  told_[newest_] = told;
  const double shown = told_[(newest_ + most_on_the_way - delay_) % most_on_the_way];
  shown_sum_ += shown;
  ++shown_ticks_;
  step_ = std::abs(step) <= longest_step ? step : 0.0;
  if (step == 0.0) return;
  // A slow motion shows in one tick what it went in many, against the mean of what was shown in them. It went
  // over the edges of a quantum somewhere within their ticks: half of the last one's force is the next one's.
  // And what comes back over an edge is where it was when it went over it.
  const double later = held_between ? 0.0 : 0.5 * shown;
  const bool back = !held_between && step_ * last_step_ < 0.0;
  const double way = back ? step_ - std::copysign(std::min(quantum_, std::abs(step_)), step_) : step_;
  work_ += way * (shown_sum_ - later) / static_cast<double>(shown_ticks_);
  last_step_ = step_;
  shown_sum_ = later;
  shown_ticks_ = 0;
}

void PassivityLayer::felt(double travel, double force) noexcept {
  const double step = travel - travel_;
  const double bounded = std::isfinite(force) ? std::clamp(force, -strongest_force, strongest_force) : 0.0;
  if (std::abs(step) <= longest_step) felt_work_ += 0.5 * (bounded + force_) * step;
  travel_ = travel;
  force_ = bounded;
}

void PassivityLayer::compare(double work, double felt, double taken, double stored) noexcept {
  constexpr double most = 2e-3;  // J: a swing of millimetres; more is no swing
  const double given = taken - felt, lost = std::min(work, work_) - std::max(stored, 0.0);
  if (!std::isfinite(given) || !std::isfinite(lost)) return;
  lost_ = std::max(lost_, lost);
  owed_ = std::clamp(owed_ + given - given_, 0.0, most);
  given_ = given;
}

double PassivityLayer::damping_force(double speed) noexcept {
  constexpr double damping = 5.0;     // N s/m, chosen: stable on every device of devices.toml
  constexpr double smoothing = 5e-3;  // s
  constexpr double memory = 0.2;      // s: a swing goes on making debts, and what came to rest is forgiven
  if (std::isfinite(speed))
    speed_ += (std::clamp(speed, -top_speed, top_speed) - speed_) * period_ / (period_ + smoothing);
  owed_ -= owed_ * period_ / memory;
  const double wanted = damping * speed_ * speed_ * period_;
  if (owed_ <= 0.0 || wanted <= 0.0) return 0.0;
  const double share = std::min(owed_ / wanted, 1.0);
  owed_ -= share * wanted;
  return share * damping * speed_;
}

// J, in the tank.
double PassivityLayer::left() const noexcept { return std::max(work_ - lost_, 0.0); }

// m, that the device may go with such a force until another can take its place, and what a quantum hides of
// it; negative where it went against the force.
double PassivityLayer::way_with(double force) const noexcept {
  const double with = force > 0.0 ? -step_ : step_;  // m, in the last tick
  return with < 0.0 ? with : with * (1.0 + delay_time_ / period_) + quantum_;
}

double PassivityLayer::ceiling(double force) const noexcept {
  const double way = way_with(force);
  return way > 0.0 ? left() / way : std::numeric_limits<double>::infinity();
}

// F^2 / (2 K) + F way = left.
double PassivityLayer::soft_ceiling(double force) const noexcept {
  const double push = stiffness_ * way_with(force);
  return std::sqrt(push * push + 2.0 * stiffness_ * left()) - push;
}

}  // namespace acus::haptics
