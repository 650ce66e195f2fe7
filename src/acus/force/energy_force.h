// The hand's force from the energy balance (paper Eq. 14, 17, 18, signs mended).
//
// Eq. 14: work of the hand = change of all stored energy + all work spent. Over a travel dx of the hand along
// its force (theta = 0 at the hub, cos theta = 1) the hand's force is therefore
//   F_h = (dU + dW_c + dW_friction + dW_damping + dW_numerical + dT) / (dx cos theta).
// Eq. 17 writes dW_c where Eq. 14 needs dW_e, and Eq. 18 carries dU with the other sign; both would let a
// tissue that stores energy pull the hand in.
#pragma once

#include <array>
#include <cmath>

namespace acus::force {

// The balance is taken over the last stretch of one-way travel at least this long, m: at rest dx -> 0, and
// the last value stands.
inline constexpr double energy_force_travel = 0.1e-3;

class EnergyForce {
 public:
  // Takes in the hand's travel [m] and where its work has gone [J], one step after another. Returns N,
  // positive when it pushes the hand back out. After a start or a turn it keeps its value until the hand has
  // moved enough.
  double after(double travel, double accounted) {
    if (count_ == 0 || (travel - latest().travel) * heading_ < 0.0) restart(travel, accounted);
    if (heading_ == 0.0 && travel != latest().travel) heading_ = travel > latest().travel ? 1.0 : -1.0;
    if (std::abs(travel - latest().travel) >= energy_force_travel / samples) push({travel, accounted});
    for (int back = 1; back <= count_; ++back) {
      const Sample& from = ring_[(first_ + count_ - back) % ring_.size()];
      if (std::abs(travel - from.travel) < energy_force_travel) continue;
      value_ = (accounted - from.accounted) / (travel - from.travel);
      break;
    }
    return value_;
  }

 private:
  struct Sample {
    double travel = 0.0;
    double accounted = 0.0;
  };
  static constexpr int samples = 20;

  const Sample& latest() const { return ring_[(first_ + count_ - 1) % ring_.size()]; }
  void restart(double travel, double accounted) {
    count_ = 0;
    heading_ = 0.0;
    push({travel, accounted});
  }
  void push(const Sample& sample) {
    if (count_ == static_cast<int>(ring_.size())) {
      first_ = (first_ + 1) % ring_.size();
      --count_;
    }
    ring_[(first_ + count_) % ring_.size()] = sample;
    ++count_;
  }

  std::array<Sample, samples + 1> ring_{};
  std::size_t first_ = 0;
  int count_ = 0;
  double heading_ = 0.0;  // +1 in, -1 out, 0 unknown
  double value_ = 0.0;
};

}  // namespace acus::force
