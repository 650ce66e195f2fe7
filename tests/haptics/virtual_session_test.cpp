// Whole sessions of simulated devices in simulated hands: nothing diverges, nothing hums, nothing gives
// energy away.
#include "virtual_session.h"

#include <gtest/gtest.h>

#include <ostream>

#include "acus/needle/buckling.h"

namespace acus::haptics {
namespace {

struct Held {
  const char* device;
  const char* hand_name;
  HandModel hand;
  double period;  // s, of the simulation
};
void PrintTo(const Held& held, std::ostream* to) {
  *to << held.device << ", " << held.hand_name << ", " << 1e3 * held.period << " ms";
}

// The 200 mm needle into a coarse block; it buckles and punctures on the way.
Trial pushing(const Held& held) {
  Trial trial;
  trial.device = *find_device_limits(held.device);
  trial.hand = held.hand;
  trial.scene.needle.length = 0.2;
  trial.scene.contact.rupture_force = 0.66;
  trial.scene.tissue.tetrahedra = 300;
  trial.scene.run.time_step = held.period;
  trial.plan = [](double s) { return s < 1.0 ? 0.0 : std::min(0.05 * (s - 1.0), 40e-3); };  // m
  trial.duration = 5.0;
  return trial;
}

class VirtualSession : public testing::TestWithParam<Held> {};

TEST_P(VirtualSession, pushes_the_needle_in_and_comes_to_rest) {
  const Trial trial = pushing(GetParam());
  const Finding found = run(trial);
  EXPECT_TRUE(found.finite);
  EXPECT_EQ(found.fault, GateFault::none);
  EXPECT_LE(found.largest_force, trial.device.peak_force);
  EXPECT_LE(found.largest_rise, 0.5 + 1e-12);
  EXPECT_LE(found.largest_fall, 1.0 + 1e-12);
  EXPECT_GE(found.least_port_energy, -1e-6);
  EXPECT_LT(found.top_speed, 0.2);
  EXPECT_GT(found.largest_travel, 15e-3);  // it did go in
  EXPECT_LE(found.limit_cycle, 0.1e-3);
  // At rest the hand feels what the needle does.
  EXPECT_NEAR(found.last_force, found.frame.hand_force, 0.02);
}

INSTANTIATE_TEST_SUITE_P(Of, VirtualSession,
                         testing::Values(Held{"touch", "light grip", light_grip, 1e-3},
                                         Held{"touch", "whole arm", whole_arm, 5e-3},
                                         Held{"premium", "light grip", light_grip, 5e-3},
                                         Held{"premium", "whole arm", whole_arm, 1e-3},
                                         Held{"ice", "light grip", light_grip, 1e-3},
                                         Held{"ice", "light grip", light_grip, 5e-3},
                                         Held{"inverse3", "whole arm", whole_arm, 5e-3},
                                         Held{"omega", "whole arm", whole_arm, 5e-3}));

// The same push as in haptic_loop_test.cpp, where nothing comes late: the hand feels the bare column buckle.
TEST(BareColumn, is_felt_to_buckle_at_its_critical_load) {
  Trial trial = pushing({"touch", "light grip", light_grip, 1e-3});
  trial.scene.tissue.rigid = true;
  trial.plan = [](double t) { return std::clamp(40e-3 * (t - 0.8), 0.0, 40e-3); };  // m
  trial.duration = 2.5;
  const Finding found = run(trial);
  const double critical =
      needle::critical_load(needle::bending_rigidity(trial.scene.needle), 0.2, trial.scene.needle.support);
  EXPECT_EQ(found.fault, GateFault::none);
  EXPECT_NEAR(found.frame.hand_force, critical, 0.1 * critical);
  // At worst the hub stops dead, and handle and hand run on into the coupling: v sqrt(K m) and what is
  // stretched in the two milliseconds before the simulation has answered.
  const VirtualCoupling coupling = coupling_for(trial.device, 1e-3);
  const double speed = 40e-3, mass = trial.device.mass + trial.hand.mass;
  EXPECT_GT(found.largest_force, 0.9 * critical);
  EXPECT_LT(found.largest_force, critical + speed * (std::sqrt(coupling.stiffness * mass) + coupling.damping +
                                                     2e-3 * coupling.stiffness));
}

TEST(StalledSimulation, leaves_the_hand_with_nothing_within_100_ms) {
  Trial trial = pushing({"touch", "whole arm", whole_arm, 5e-3});
  trial.duration = 1.9;  // the needle is bent and pushes back
  const double pushing_back = run(trial).last_force;
  ASSERT_GT(pushing_back, 0.4);
  trial.stalls = 1.8;
  trial.duration = 2.0;
  const Finding found = run(trial);
  EXPECT_LE(found.longest_force_after_stall, 0.1);
  EXPECT_EQ(found.last_force, 0.0);
  EXPECT_EQ(found.fault, GateFault::stale);
}

}  // namespace
}  // namespace acus::haptics
