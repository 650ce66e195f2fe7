// The hand of a scene: where it is along the axis of insertion, step by step. One that was planned goes its
// way whatever happens; a person feels the needle.
#pragma once

#include <optional>

#include "acus/sim/person.h"
#include "acus/sim/scene.h"

namespace acus {

class Hand {
 public:
  Hand(const HandScene& scene, double time_step) : scene_(scene), time_step_(time_step) {}

  // Travel from first touch at the end of the next step, after `force` [N] was felt on the hand in the last
  // one (Frame::hand_force); nothing once the hand has done all it was asked to. Allocates nothing. m
  std::optional<double> next(double force);

 private:
  HandScene scene_;
  double time_step_;  // s
  int steps_ = 0;
  Person person_;
};

// Where the hand is before the first step. m from first touch
double start_travel(const HandScene& hand);

// Of a hand that feels nothing: travel from first touch at `time` [s]; before the first and after the last
// moment it rests. m
double planned_travel(const HandScene& hand, double time);

// When the hand has done all it was asked to do; of a person, at the latest. s
double duration(const HandScene& hand);

// Number of steps that this takes.
int step_count(const HandScene& hand, double time_step);

// The deepest the hand ever goes. m from first touch
double furthest_travel(const HandScene& hand);

// By how much the grip gives way under a force. m/N
double grip_compliance(const HandScene& hand);

}  // namespace acus
