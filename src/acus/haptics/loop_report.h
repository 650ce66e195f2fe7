// What a haptic loop says about itself, in numbers and in words: was it on time, was the scene too heavy,
// what did the gate have to do.
#pragma once

#include <string>

#include "acus/haptics/duration_histogram.h"
#include "acus/haptics/force_gate.h"
#include "acus/sim/frame.h"

namespace acus::haptics {

struct LoopReport {
  DurationHistogram period;     // from one tick to the next
  DurationHistogram work;       // of our part of a tick
  DurationHistogram step;       // of the simulation's steps
  DurationHistogram age;        // of the simulation's word when a tick used it
  long lowered = 0;             // ticks in which the force was lowered lest it give energy away
  double wall_time = 0.0;       // s, of the simulation's thread
  double simulated_time = 0.0;  // s
  double time_step = 0.0;       // s, of the simulation
  double largest_force = 0.0;   // N, that left the gate
  GateFault fault = GateFault::none;
  GateInterventions interventions;
  Health health = Health::good;
  std::string not_real_time;  // empty when it was; else why not
};

// A tick that came later than this after the one before was late. s
inline constexpr double late_tick = 2e-3;

// How much faster than the wall the simulation ran: 1 when it kept up. 0 before its first step.
double real_time_factor(const LoopReport& report);

// Some lines for people, each ended.
std::string in_words(const LoopReport& report);
// Why the gate took the force away, for people; empty without a fault.
std::string in_words(GateFault fault);

}  // namespace acus::haptics
