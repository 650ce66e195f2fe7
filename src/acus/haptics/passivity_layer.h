// Keeps the haptic loop from giving energy to the hand that neither the hand nor the needle has put in, however
// slow the simulation is. Two parts, because either alone is not enough:
//  - a tank (Franken, Stramigioli et al., IEEE T-RO 27(4), 2011): what the hand has done to the device so far; a
//    force that goes with the motion draws from it, and an empty tank gives no more. Passive by construction, but a
//    tank filled by an hour of friction would feed a swing for long;
//  - so a damper takes back at once what the felt force gave away against the needle's own account (reference
//    energy following: Ryu, Preusche, Hannaford, Hirzinger, IEEE T-CST 13(3), 2005). Between the words of a slow
//    simulation the felt force is a guess; where it asked less work of the hand than the needle then took, or gave
//    more back, the difference was made of nothing.
#pragma once

#include <array>

#include "acus/haptics/device_limits.h"

namespace acus::haptics {

class PassivityLayer {
 public:
  // `period` > 0 [s] is a tick's.
  PassivityLayer(const DeviceLimits& limits, double period);

  // The device has moved by `step` [m] since the last tick, in which it was told to show `told` [N]: what it shows
  // comes later by the device's delay. Once a tick, before all else.
  void moved(const Vec3& step, const Vec3& told) noexcept;

  // The hand has come to `travel` [m] along the needle, against `force` [N] by the local force. Once a tick.
  void felt(double travel, double force) noexcept;

  // What the hand has done against the felt force so far. J
  double felt_work() const { return felt_work_; }

  // A word of the simulation: the needle had taken `needle` [J] from the hand where the hand had felt to do `felt`
  // [J].
  void compare(double needle, double felt) noexcept;

  // The damper's force against a motion at `speed` [m/s] along the needle, positive against the hand. N
  double damping_force(double speed) noexcept;

  // The strongest force along `force` that a device moving at `velocity` [m/s] may show: N, infinite where the force
  // is against the motion. A device at rest may have moved by less than a quantum, so there the tank counts too.
  double ceiling(const Vec3& force, const Vec3& velocity) const noexcept;

  double tank() const { return tank_; }  // J
  double owed() const { return owed_; }  // J, given away and not yet taken back

 private:
  static constexpr std::size_t most_on_the_way = 16;

  double quantum_, reach_;  // m; s, for which a force acts before another can take its place
  std::size_t delay_;       // whole ticks
  std::array<Vec3, most_on_the_way> told_;
  std::size_t newest_ = 0;
  Vec3 shown_sum_ = Vec3::Zero();  // N, since the device was last seen to move
  long shown_ticks_ = 0;
  double period_;
  double tank_ = 0.0, felt_work_ = 0.0;
  double travel_ = 1e9;  // m: the first place is not come to
  double force_ = 0.0;   // N
  double given_ = 0.0;  // J, in all, as of the last word
  double owed_ = 0.0;
  double speed_ = 0.0;  // m/s, along the needle, smoothed: a quantum in one tick is not a motion
};

}  // namespace acus::haptics
