// Person: a hand that pushes as one of the paper's users would. It is as slow as the force makes it (hill.h),
// shakes (tremor.h), and when something happens that it feels (felt.h) goes on until it could react, stands
// still for a while, and goes on.
//
// What happens after a puncture is not put in: the grip that was pressed together and the muscle that was
// held back drive the needle on until the hand has reacted.
#pragma once

#include "acus/sim/felt.h"
#include "acus/sim/scene.h"

namespace acus {

struct Person {
  enum class Doing { pushing, pulling, nothing_more };

  long steps = 0;       // taken so far
  double aim = 0.0;     // m, travel of the hand without its tremor
  double travel = 0.0;  // m, of the hand
  Felt felt;
  double still_from = -1.0;   // s, of the last pause, which may be still to come
  double still_until = -1.0;  // s
  double settled = 0.0;       // m, of the aim, from where on it is no longer attentive
  double turned = 0.0;        // s, when it began to pull back
  Doing doing = Doing::pushing;
};

// One step later, with `force` [N] on the hand so far. Allocates nothing.
Person person_after(Person person, const HandScene& hand, double force, double time_step);

// The longest that it may take. s
double longest_trial(const HandScene& hand);

}  // namespace acus
