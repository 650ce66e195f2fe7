// The hand as it was planned: where it is along the axis of insertion at a time.
#pragma once

#include "acus/sim/scene.h"

namespace acus {

// Travel from first touch at `time` [s]; before the first and after the last moment the hand rests. m
double hand_travel(const HandScene& hand, double time);

// When the hand has done all it was asked to do. s
double duration(const HandScene& hand);

// The deepest the hand ever goes. m from first touch
double furthest_travel(const HandScene& hand);

// By how much the grip gives way under a force. m/N
double grip_compliance(const HandScene& hand);

}  // namespace acus
