// Summary: what an insertion came to, gathered frame by frame.
#pragma once

#include <optional>
#include <span>

#include "acus/sim/frame.h"

namespace acus {

// What happened before the tissue gave way, if it did.
enum class Outcome { straight_puncture, buckled_then_punctured, never_punctured };

struct Summary {
  int steps = 0;
  double time = 0.0;  // s
  Health health = Health::good;
  double peak_hand_force = 0.0;         // N
  double peak_hand_force_travel = 0.0;  // m, hand travel at that peak
  double peak_tip_force = 0.0;          // N
  double peak_deflection = 0.0;         // m
  double peak_tip_depth = 0.0;          // m
  double peak_tip_aside = 0.0;          // m
  double peak_energy_force_gap = 0.0;   // N, largest |energy_force - hand_force|
  std::optional<double> rupture_force;  // N, largest tip force up to the first puncture
  double peak_work_hand = 0.0;  // J, largest work of the hand so far: what the residual is compared with
  double peak_energy_residual = 0.0;  // J, largest absolute value
  force::Ledger ledger;               // J, at the end
  double mean_solver_iterations = 0.0;
  int peak_solver_iterations = 0;
};

// Takes one more step into the summary. `events` are all up to this frame.
void add(Summary& summary, const Frame& frame, std::span<const Event> events);

Outcome outcome(std::span<const Event> events);

// Largest residual of the ledger over the largest work of the hand; 0 when the hand has done no work.
double relative_energy_residual(const Summary& summary);

// Empty when all went well; else what went wrong and what to try.
const char* complaint(Health health);

}  // namespace acus
