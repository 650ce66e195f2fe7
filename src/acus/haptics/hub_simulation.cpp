#include "acus/haptics/hub_simulation.h"

namespace acus::haptics {

LocalForce HubSimulation::step(double hand_travel, double felt, double now) {
  const Frame& frame = simulation_.step(hand_travel);
  if (frame.health != Health::good) return last_;
  constexpr double top_speed = 1.2;  // m/s: a faster hand is no longer followed (force_gate.h)
  last_.time = now;
  if (begun_) last_.work += 0.5 * (last_.force + frame.hand_force) * (hand_travel - last_.travel);
  begun_ = true;
  last_.felt = felt;
  last_.travel = hand_travel;
  last_.force = frame.hand_force;
  last_.stiffness = simulation_.hand_stiffness();
  last_.radius = 2.0 * top_speed *
                 simulation_.scene().run.time_step;  // as far as the hand can come before the next word
  last_.jumped = simulation_.events().size() > events_;
  events_ = simulation_.events().size();
  return last_;
}

}  // namespace acus::haptics
