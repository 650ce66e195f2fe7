#include "acus/haptics/hold_damper.h"

#include <algorithm>
#include <cmath>

namespace acus::haptics {

void HoldDamper::word(double interval) noexcept {
  held_ = std::isfinite(interval) ? std::clamp(interval - followed_age, 0.0, followed_age) : 0.0;
}

double HoldDamper::force(double step, double stiffness, bool may_be_held) noexcept {
  constexpr double margin = 2.0;       // as that of the coupling's stiffness
  constexpr double smoothing = 3e-3;   // s: a quantum comes as a push and not as a blow
  constexpr double farthest = 0.2e-3;  // m: swings of a few quanta; wider ones the passivity layer sees
  if (std::isfinite(step)) way_ = std::clamp(way_ + step, -farthest, farthest);
  if (may_be_held) return 0.0;
  const double damping = margin * 0.5 * stiffness * held_ * held_ / followed_age;  // N s/m
  const double answered = way_ * period_ / (period_ + smoothing);                  // m
  way_ -= answered;
  return damping * answered / period_;
}

}  // namespace acus::haptics
