#include "acus/sim/summary.h"

#include <algorithm>
#include <cmath>

namespace acus {
namespace {

const Event* first(EventKind kind, std::span<const Event> events) {
  const auto found =
      std::find_if(events.begin(), events.end(), [&](const Event& e) { return e.kind == kind; });
  return found == events.end() ? nullptr : &*found;
}

}  // namespace

void add(Summary& summary, const Frame& frame, std::span<const Event> events) {
  ++summary.steps;
  summary.time = frame.time;
  summary.health = frame.health;
  if (frame.hand_force > summary.peak_hand_force) {
    summary.peak_hand_force = frame.hand_force;
    summary.peak_hand_force_travel = frame.hand_travel;
  }
  summary.peak_tip_force = std::max(summary.peak_tip_force, frame.tip_force);
  summary.peak_deflection = std::max(summary.peak_deflection, frame.deflection);
  summary.peak_tip_depth = std::max(summary.peak_tip_depth, frame.tip_depth);
  summary.peak_tip_aside = std::max(summary.peak_tip_aside, frame.tip_aside);
  summary.peak_energy_force_gap =
      std::max(summary.peak_energy_force_gap, std::abs(frame.energy_force - frame.hand_force));
  if (!summary.rupture_force && first(EventKind::puncture, events) != nullptr)
    summary.rupture_force = summary.peak_tip_force;
  summary.peak_work_hand = std::max(summary.peak_work_hand, frame.ledger.work_hand);
  summary.peak_energy_residual = std::max(summary.peak_energy_residual, std::abs(frame.energy_residual));
  summary.ledger = frame.ledger;
  summary.mean_solver_iterations +=
      (frame.solver_iterations - summary.mean_solver_iterations) / summary.steps;
  summary.peak_solver_iterations = std::max(summary.peak_solver_iterations, frame.solver_iterations);
}

Outcome outcome(std::span<const Event> events) {
  const Event* puncture = first(EventKind::puncture, events);
  if (puncture == nullptr) return Outcome::never_punctured;
  const Event* buckling = first(EventKind::buckling, events);
  const bool bent_before = buckling != nullptr && buckling->time <= puncture->time;
  return bent_before ? Outcome::buckled_then_punctured : Outcome::straight_puncture;
}

double relative_energy_residual(const Summary& summary) {
  return summary.peak_work_hand > 0.0 ? summary.peak_energy_residual / summary.peak_work_hand : 0.0;
}

const char* complaint(Health health) {
  switch (health) {
    case Health::good:
      return "";
    case Health::solver_broke_down:
      return "the linear solver broke down; a shorter run.time_step_ms or a finer tissue mesh may help";
    case Health::not_finite:
      return "a number ceased to be finite; a shorter run.time_step_ms may help";
    case Health::needle_folded:
      return "the needle folded over, beyond what its model holds for; end the movement of the hand earlier";
    case Health::hub_at_entry:
      return "the hub reached the entry and no free needle is left; end the movement of the hand earlier";
  }
  return "";
}

}  // namespace acus
