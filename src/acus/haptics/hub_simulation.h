// The simulation as the haptic loop sees it: told where the hand is, it answers with a local force.
#pragma once

#include <cstddef>

#include "acus/haptics/local_force.h"
#include "acus/sim/simulation.h"

namespace acus::haptics {

class HubSimulation {
 public:
  // `simulation` must outlive this, and its scene be held_by() the device (virtual_coupling.h).
  explicit HubSimulation(Simulation& simulation) : simulation_(simulation) {}

  // Advances one time step to where the hand is; what it then says, as of `now` [s] of the loop's clock.
  // After a step that failed it says nothing new, so that the gate sees its word grow old. Allocates nothing.
  LocalForce step(const HandMotion& hand, double now);

  const Simulation& simulation() const { return simulation_; }

 private:
  Simulation& simulation_;
  LocalForce last_;
};

}  // namespace acus::haptics
