#include "acus/numeric/extrapolation.h"

#include "acus/numeric/simd.h"

namespace acus::numeric {
namespace {

using Differences = std::array<NodeVector, Extrapolation::most>;

// Replaces the differences by the next ones. Returns the square of what each order missed the value by.
ACUS_KERNEL std::array<double, Extrapolation::most> advance_differences(Differences& difference,
                                                                        const NodeVector& value,
                                                                        const NodeVector& last) {
  Lane4 missed[Extrapolation::most] = {};
  for (std::size_t i = 0; i < value.size(); i += node_stride) {
    Lane4 next = load4(&value[i]) - load4(&last[i]);
    for (int k = 0; k < Extrapolation::most; ++k) {
      const Lane4 before = load4(&difference[k][i]);
      store4(&difference[k][i], next);
      next = next - before;
      missed[k] += next * next;
    }
  }
  return {sum(missed[0]), sum(missed[1]), sum(missed[2])};
}

}  // namespace

Extrapolation build_extrapolation(int nodes) {
  Extrapolation e;
  for (NodeVector& d : e.difference) d.assign(static_cast<std::size_t>(node_stride) * nodes, 0.0);
  return e;
}

void extrapolate(NodeVector& x, const Extrapolation& e) {
  for (int k = 0; k < e.order; ++k) add_scaled_into(x, 1.0, e.difference[k]);
}

void learn(Extrapolation& e, const NodeVector& value, const NodeVector& last) {
  const auto missed = advance_differences(e.difference, value, last);
  e.order = 1;
  for (int k = 1; k < Extrapolation::most; ++k)
    if (missed[k] < missed[e.order - 1]) e.order = k + 1;
}

}  // namespace acus::numeric
