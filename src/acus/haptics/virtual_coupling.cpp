#include "acus/haptics/virtual_coupling.h"

#include <algorithm>

namespace acus::haptics {

VirtualCoupling coupling_for(const DeviceLimits& limits, double period) {
  constexpr double damping =
      0.3;  // N s/m, chosen: a drag of 3 mN at 10 mm/s, 17 mN for a quantum of 0.055 mm
  constexpr double gain_margin = 2.0;  // of the stiffness
  const double largest = (limits.viscous + damping) / (0.5 * period + limits.delay);
  return {std::min(largest / gain_margin, limits.stiffness), damping};
}

Scene held_by(const DeviceLimits& limits, Scene scene) {
  constexpr double hardly = 1.0;  // N/m, for a device that may show no spring: 0 would be a rigid grip
  const double stiffest = std::max(coupling_for(limits).stiffness, hardly);
  double& grip = scene.hand.stiffness;
  grip = grip > 0.0 ? std::min(grip, stiffest) : stiffest;
  return scene;
}

}  // namespace acus::haptics
