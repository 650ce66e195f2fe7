// Keeps the haptic loop from giving the hand energy that is not there to give, however slow the simulation
// is: between its words the felt force is a guess, and a swing could live on wrong guesses.
//
// A tank (Franken, Stramigioli et al., IEEE T-RO 27(4), 2011) holds what the hand has put into the device,
// and a force that goes with the motion draws from it; an empty tank gives no more. A tank filled by an hour
// of friction would feed a swing for long. But needle, tissue and grip only give back what they have stored,
// and each word of the simulation says how much that is: what is above it leaves the tank, and comes back
// slowly. A tank that runs empty lets go as a spring of the coupling's stiffness does; a force that were
// there on the way in and not on the way out would chatter.
//
// A damper takes back at once what wrong guesses gave (reference energy following: Ryu, Preusche, Hannaford
// and Hirzinger, IEEE T-CST 13(3), 2005): where the felt force asked less work of the hand than the needle
// then took, or gave more back, the difference is owed.
//
// All of this is along the needle, forward positive, forces positive against the hand. Across it the guide is
// a spring and passive by itself.
#pragma once

#include <array>

#include "acus/haptics/device_limits.h"

namespace acus::haptics {

// m: no hand goes farther in a tick.
inline constexpr double longest_step = 10e-3;

class PassivityLayer {
 public:
  // `stiffness` [N/m] is the coupling's; `period` > 0 [s] is a tick's.
  PassivityLayer(const DeviceLimits& limits, double stiffness, double period);

  // Once a tick, before all else: the device has moved by `step` [m] since the last one, in which it was told
  // to show `told` [N]. What it shows comes later by the device's delay. Where the gate holds forces between
  // words, the account stays on the hand's side: to and fro over the edge of a quantum it pays for both ways,
  // and a swing on wrong guesses runs dry.
  void moved(double step, double told, bool held_between = false) noexcept;

  // Once a tick: the hand is at `travel` [m] along the needle, against `force` [N] by the local force.
  void felt(double travel, double force) noexcept;

  // What the hand has done so far: to the device, and against the local force alone. J
  double work() const { return work_; }
  double felt_work() const { return felt_work_; }

  // A word of the simulation: when the two works were `work` and `felt`, the needle had taken `taken` from
  // the hand, and so much was `stored`. J
  void compare(double work, double felt, double taken, double stored) noexcept;

  // Once a tick: the damper's force at `speed` [m/s] along the needle, against it. N
  double damping_force(double speed) noexcept;

  // How strong a force of the sign of `force` the device may show now: N, infinite where that is against its
  // motion. A device at rest may have moved by less than a quantum, so there the tank counts too.
  double ceiling(double force) const noexcept;

  // The same for the needle's part of it, and never above: a force that stretches the coupling by what is
  // left in the tank. What damps comes on top. N
  double soft_ceiling(double force) const noexcept;

 private:
  static constexpr std::size_t most_on_the_way = 16;

  double left() const noexcept;
  double way_with(double force) const noexcept;

  double period_, quantum_, stiffness_;  // s, m, N/m
  double delay_time_;                    // s
  std::size_t delay_;                    // whole ticks
  double step_ = 0.0;                    // m, of the last tick
  double last_step_ = 0.0;               // m, of the last tick in which the device was seen to move
  std::array<double, most_on_the_way> told_{};
  std::size_t newest_ = 0;
  double shown_sum_ = 0.0;  // N, since the device was last seen to move
  long shown_ticks_ = 0;
  double work_ = 0.0, lost_ = 0.0;  // J; the tank holds the difference

  double travel_ = 0.0, force_ = 0.0;  // of the last tick
  double felt_work_ = 0.0;
  double given_ = 0.0, owed_ = 0.0;  // J, in all as of the last word, and not yet taken back
  double speed_ = 0.0;               // m/s, smoothed: a quantum in one tick is not a motion
};

}  // namespace acus::haptics
