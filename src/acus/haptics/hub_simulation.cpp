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
  last_.radius = 2.0 * top_speed * simulation_.scene().run.time_step;  // as far as a hand comes in two steps
  last_.events = static_cast<long>(simulation_.events().size());
  const double give = grip_compliance(simulation_.scene().hand);
  last_.stored = force::stored(frame.ledger) + 0.5 * give * frame.hand_force * frame.hand_force;
  last_.hand = hand;
  return last_;
}

}  // namespace acus::haptics
