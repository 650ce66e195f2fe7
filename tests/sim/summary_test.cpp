#include "acus/sim/summary.h"

#include <gtest/gtest.h>

#include <vector>

namespace acus {
namespace {

Event at(double time, EventKind kind) { return {.time = time, .kind = kind}; }

TEST(Summary, outcome_asks_what_came_before_the_first_puncture) {
  using Events = std::vector<Event>;
  const Event contact = at(0.0, EventKind::contact), early = at(1.0, EventKind::buckling);
  const Event puncture = at(2.0, EventKind::puncture), late = at(3.0, EventKind::buckling);
  EXPECT_EQ(outcome({}), Outcome::never_punctured);
  EXPECT_EQ(outcome(Events{contact, early}), Outcome::never_punctured);
  EXPECT_EQ(outcome(Events{contact, puncture}), Outcome::straight_puncture);
  EXPECT_EQ(outcome(Events{contact, puncture, late}), Outcome::straight_puncture);
  EXPECT_EQ(outcome(Events{contact, early, puncture}), Outcome::buckled_then_punctured);
}

TEST(Summary, keeps_peaks_and_the_tip_force_up_to_the_puncture) {
  const double hand[] = {0.5, 1.0, 0.3, 1.4}, tip[] = {0.4, 0.9, 0.2, 1.2};
  std::vector<Event> events;
  Summary summary;
  for (int i = 0; i < 4; ++i) {
    if (i == 2) events.push_back(at(3.0, EventKind::puncture));
    Frame frame;
    frame.time = 1.0 + i;
    frame.hand_travel = 0.01 * (1 + i);
    frame.hand_force = hand[i];
    frame.tip_force = tip[i];
    frame.ledger.work_hand = 0.1 * hand[i];
    frame.energy_residual = i == 1 ? -1e-3 : 0.0;
    frame.solver_iterations = 10 * i;
    add(summary, frame, events);
  }
  EXPECT_EQ(summary.steps, 4);
  EXPECT_EQ(summary.peak_hand_force, 1.4);
  EXPECT_EQ(summary.peak_hand_force_travel, 0.04);
  EXPECT_EQ(summary.peak_tip_force, 1.2);
  ASSERT_TRUE(summary.rupture_force);
  EXPECT_EQ(*summary.rupture_force, 0.9);  // not the later, larger one
  EXPECT_DOUBLE_EQ(summary.mean_solver_iterations, 15.0);
  EXPECT_EQ(summary.peak_solver_iterations, 30);
  EXPECT_DOUBLE_EQ(relative_energy_residual(summary), 1e-3 / 0.14);
}

}  // namespace
}  // namespace acus
