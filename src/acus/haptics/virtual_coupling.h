// The spring and damper between a device and the hub: as stiff as the device can show without losing
// stability, however stiff the needle is.
#pragma once

#include "acus/haptics/device_limits.h"
#include "acus/haptics/local_force.h"

namespace acus::haptics {

struct VirtualCoupling {
  double stiffness = 0.0;  // N/m
  double damping = 0.0;    // N s/m
};

// Half of what sampling and delay allow, K_max = (b + B) / (T/2 + t_d) (Gil, Sanchez, Hulin et al. 2009) with
// the device's own viscous friction b and the coupling's damping B, and no more than the device's maker
// allows. `period` > 0 [s] is a tick's.
VirtualCoupling coupling_for(const DeviceLimits& limits, double period);

// Where the hub is when the coupling's spring and the needle balance, K (device - hub) = F(hub), the device
// being at `device_travel` [m]: within the local force's radius. A needle that gives way is taken as one of
// constant force, so that there is one balance. m
double balanced_hub(const VirtualCoupling& coupling, const LocalForce& local, double device_travel);

}  // namespace acus::haptics
