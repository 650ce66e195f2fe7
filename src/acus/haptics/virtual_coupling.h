// The spring and damper between a device and the hub: as stiff as the device can show without losing
// stability, however stiff the needle is. Along the needle the spring is the grip of the scene's hand, solved
// together with needle and tissue; across it and for the damper the servo answers.
#pragma once

#include "acus/haptics/device_limits.h"
#include "acus/sim/scene.h"

namespace acus::haptics {

struct VirtualCoupling {
  double stiffness = 0.0;  // N/m
  double damping = 0.0;    // N s/m
};

// Half of what sampling and delay allow, K_max = (b + B) / (T/2 + t_d) (Gil, Sanchez, Hulin et al. 2009) with
// the device's own viscous friction b and the coupling's damping B, and no more than the device's maker
// allows. `period` > 0 [s] is a tick's.
VirtualCoupling coupling_for(const DeviceLimits& limits, double period = 1e-3);

// The scene with its needle held by a hand on that device: through the coupling, unless the scene's own grip
// is softer.
Scene held_by(const DeviceLimits& limits, Scene scene);

}  // namespace acus::haptics
