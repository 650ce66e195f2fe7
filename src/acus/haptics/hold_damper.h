// Takes back what the force gate gives while it holds a force.
//
// Words that come less often than the gate follows them (force_gate.h) leave a time h in each of their
// periods in which the force stands still. A hand that goes on at speed v is then given up to K (v h)^2 / 2
// by a needle of stiffness K: a spring sampled every h, passive only with a friction of K h / 2 meanwhile
// (Colgate and Schenkel, J. Robotic Systems 14(1), 1997). While it holds, the gate damps by less. So the
// friction stands in the time f that is followed, K h^2 / (2 f) at least, and answers there also for the way
// gone while the force was held.
#pragma once

#include "acus/haptics/force_gate.h"

namespace acus::haptics {

class HoldDamper {
 public:
  // `period` > 0 [s] is a tick's.
  explicit HoldDamper(double period) : period_(period) {}

  // A word has come `interval` [s] after the one before.
  void word(double interval) noexcept;

  // Once a tick: the device has moved by `step` [m]. The force along the needle, against that way, where the
  // felt force is `stiffness` [N/m] stiff. N; nothing in a tick whose force may be held.
  double force(double step, double stiffness, bool may_be_held) noexcept;

  // Whether words come so rarely that the gate holds the force between them.
  bool holds() const { return held_ > 0.0; }

 private:
  double period_;
  double held_ = 0.0;  // s, in each period of the words
  double way_ = 0.0;   // m, not yet answered for
};

}  // namespace acus::haptics
