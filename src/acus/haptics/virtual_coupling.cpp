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

double balanced_hub(const VirtualCoupling& coupling, const LocalForce& local, double device_travel) {
  const double needle = std::max(local.stiffness, 0.0);
  const double way =
      (coupling.stiffness * (device_travel - local.travel) - local.force) / (coupling.stiffness + needle);
  return local.travel + std::clamp(way, -local.radius, local.radius);
}

}  // namespace acus::haptics
