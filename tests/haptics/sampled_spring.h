// A spring and a damper rendered through a sampled loop, and whether a handle swings in it for ever.
#pragma once

#include <algorithm>

#include "acus/haptics/handle.h"

namespace acus::haptics {

// How a swing in a virtual spring K with a virtual damper B changes over a long time: above 1 it grows. The
// handle alone, no hand, no dry friction, no quanta: the linear system of the theory.
inline double growth(double K, double B, const HandModel& hand, DeviceLimits limits, double T,
                     double duration = 40.0) {
  limits.coulomb = limits.quantum = 0.0;
  Handle handle(limits, hand, {1e-3, 0.0, 0.0});
  Vec3 before = handle.position();
  double early = 0.0, late = 0.0;
  const auto ticks = static_cast<long>(duration / T);
  for (long i = 0; i < ticks; ++i) {
    const Vec3 velocity = (handle.position() - before) / T;
    before = handle.position();
    handle.command(-K * handle.position() - B * velocity);
    handle.advance_to(static_cast<double>(i + 1) * T, {});
    const double energy = 0.5 * (limits.mass + hand.mass) * handle.velocity().squaredNorm() +
                          0.5 * (K + hand.stiffness) * handle.position().squaredNorm();
    if (i > ticks / 8 && i < ticks / 4) early = std::max(early, energy);
    if (i > ticks * 7 / 8) late = std::max(late, energy);
    if (energy > 1e3) return 1e9;
  }
  return late / early;
}

}  // namespace acus::haptics
