#include "acus/haptics/hub_simulation.h"

#include "acus/sim/hand.h"

namespace acus::haptics {

LocalForce HubSimulation::step(const HandMotion& hand, double now) {
  const Frame& frame = simulation_.step(hand.travel);
  if (frame.health != Health::good) return last_;
  constexpr double top_speed = 1.2;  // m/s: a faster hand is no longer followed (force_gate.h)
  if (last_.time >= 0.0) last_.taken += 0.5 * (last_.force + frame.hand_force) * (hand.travel - last_.travel);
  last_.time = now;
  last_.travel = hand.travel;
  last_.force = frame.hand_force;
  last_.stiffness = simulation_.hand_stiffness();
  last_.radius = 2.0 * top_speed *
                 simulation_.scene().run.time_step;  // as far as the hand can come before the next word
  last_.jumped = simulation_.events().size() > events_;
  const double give = grip_compliance(simulation_.scene().hand);
  last_.stored = force::stored(frame.ledger) + 0.5 * give * frame.hand_force * frame.hand_force;
  last_.hand = hand;
  events_ = simulation_.events().size();
  return last_;
}

}  // namespace acus::haptics
