// The hand as it was planned: where the hub is along the axis of insertion at a time.
#pragma once

#include "acus/sim/scene.h"

namespace acus {

// Travel of the hub from first touch at `time` [s]; before the first and after the last moment it rests. m
double hand_travel(const HandScene& hand, double time);

// When the hand has done all it was asked to do. s
double duration(const HandScene& hand);

// The deepest the hub is ever sent. m from first touch
double furthest_travel(const HandScene& hand);

}  // namespace acus
