// Where a quantity that moves in steps will be next: Newton's backward differences.
//
// On a smooth way a parabola or a cubic goes on better than a line, after a kink it does not; so the order is
// the one that would have been best for the last step.
#pragma once

#include <array>

#include "acus/numeric/node_vector.h"

namespace acus::numeric {

struct Extrapolation {
  static constexpr int most = 3;
  // Of the last values, [nodes]: of first, second and third order.
  std::array<NodeVector, most> difference;
  int order = 1;
};
Extrapolation build_extrapolation(int nodes);

// x += the differences up to the order: from the last value to the next.
void extrapolate(NodeVector& x, const Extrapolation& e, const Team& team = one_thread);
// The next value has become known; `last` is the one before it.
void learn(Extrapolation& e, const NodeVector& value, const NodeVector& last, const Team& team = one_thread);

}  // namespace acus::numeric
