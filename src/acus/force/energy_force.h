// The hand's force from the energy balance (paper Eq. 14, 17, 18, signs mended).
//
// Eq. 14: work of the hand = change of all stored energy + all work spent. Over a travel dx of the hand along
// its force (theta = 0 at the hub, cos theta = 1) the hand's force is therefore
//   F_h = (dU + dW_c + dW_friction + dW_damping + dW_numerical + dT) / (dx cos theta).
// Eq. 17 writes dW_c where Eq. 14 needs dW_e, and Eq. 18 carries dU with the other sign; both would let a
// tissue that stores energy pull the hand in.
#pragma once

#include <cmath>

namespace acus::force {

// The balance is taken over the last one-way travel of at least this length, m: at rest dx -> 0, and the last
// value stands. At the paper's hand speeds it is less than one step of 1 ms.
inline constexpr double energy_force_travel = 5e-6;

class EnergyForce {
 public:
  EnergyForce() = default;
  explicit EnergyForce(double travel) : anchor_{travel, 0.0}, last_{travel, 0.0} {}

  // Takes in the hand's travel [m] and where its work has gone [J], one step after another. Returns N,
  // positive when it pushes the hand back out.
  double after(double travel, double accounted) {
    const double step = travel - last_.travel;
    if (step * heading_ < 0.0)
      anchor_ = last_;  // a turn: friction on the way there must not count on the way back
    if (step != 0.0) heading_ = step;
    last_ = {travel, accounted};
    if (std::abs(travel - anchor_.travel) >= energy_force_travel) {
      value_ = (accounted - anchor_.accounted) / (travel - anchor_.travel);
      anchor_ = last_;
    }
    return value_;
  }

 private:
  struct Sample {
    double travel = 0.0;     // m
    double accounted = 0.0;  // J
  };
  Sample anchor_;
  Sample last_;
  double heading_ = 0.0;  // m, the last step that was not zero
  double value_ = 0.0;    // N
};

}  // namespace acus::force
