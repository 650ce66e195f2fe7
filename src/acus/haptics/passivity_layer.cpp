#include "acus/haptics/passivity_layer.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace acus::haptics {
namespace {

constexpr double longest_step = 10e-3;  // m, in a tick: no hand goes farther, so that is no motion

}  // namespace

PassivityLayer::PassivityLayer(const DeviceLimits& limits, double period)
    : quantum_(limits.quantum),
      reach_(period + limits.delay),
      delay_(std::min(static_cast<std::size_t>(std::lround(limits.delay / period)), most_on_the_way - 1)),
      period_(period) {
  told_.fill(Vec3::Zero());
}

void PassivityLayer::moved(const Vec3& step, const Vec3& told) noexcept {
  newest_ = (newest_ + 1) % most_on_the_way;
  told_[newest_] = told;
  shown_sum_ += told_[(newest_ + most_on_the_way - delay_) % most_on_the_way];
  ++shown_ticks_;
  if (step.squaredNorm() == 0.0) return;
  // A slow motion shows in one tick what it went in many, against the mean of what was shown in them.
  if (step.norm() <= longest_step) tank_ -= step.dot(shown_sum_) / static_cast<double>(shown_ticks_);
  shown_sum_.setZero();
  shown_ticks_ = 0;
}

void PassivityLayer::felt(double travel, double force) noexcept {
  constexpr double strongest = 100.0;  // N
  const double step = travel - travel_, bounded = std::clamp(force, -strongest, strongest);
  if (std::abs(step) <= longest_step && std::isfinite(bounded)) felt_work_ += 0.5 * (bounded + force_) * step;
  travel_ = travel;
  force_ = std::isfinite(bounded) ? bounded : 0.0;
}

void PassivityLayer::compare(double needle, double felt) noexcept {
  constexpr double most = 2e-3;  // J: a swing of millimetres; more is no swing
  const double given = needle - felt;
  if (!std::isfinite(given)) return;
  owed_ = std::clamp(owed_ + given - given_, 0.0, most);
  given_ = given;
}

double PassivityLayer::damping_force(double speed) noexcept {
  constexpr double strongest = 3.0;  // N s/m
  constexpr double smoothing = 5e-3;  // s
  constexpr double memory = 0.5;      // s: a swing goes on making debts, and what came to rest is forgiven
  constexpr double fastest = 2.0;     // m/s, beyond what the gate follows
  if (std::isfinite(speed)) speed_ += (std::clamp(speed, -fastest, fastest) - speed_) * period_ / (period_ + smoothing);
  owed_ -= owed_ * period_ / memory;
  const double wanted = strongest * speed_ * speed_ * period_;
  if (owed_ <= 0.0 || wanted <= 0.0) return 0.0;
  const double share = std::min(owed_ / wanted, 1.0);
  owed_ -= share * wanted;
  return share * strongest * speed_;
}

double PassivityLayer::ceiling(const Vec3& force, const Vec3& velocity) const noexcept {
  const double size = force.norm(), power = force.dot(velocity);
  const double way = size > 0.0 ? power / size * reach_ + quantum_ : 0.0;  // m, that it may come with the force
  if (!(power >= 0.0 && way > 0.0)) return std::numeric_limits<double>::infinity();
  return std::max(tank_, 0.0) / way;
}

}  // namespace acus::haptics
