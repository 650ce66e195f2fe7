// How well a step was solved: what the velocity it arrived at leaves of b - A v, computed afterwards in
// double.
#pragma once

namespace acus::bench {

struct Residual {
  double of_momentum = 0.0;  // over |b|, of the equation A v = b for the new velocity
  double of_change = 0.0;    // over |b - A v0|, of the same equation for the change of velocity
  double of_load = 0.0;      // over the impulse h F of what presses on the tissue
};

}  // namespace acus::bench
