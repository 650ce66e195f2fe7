#include "acus/numeric/extrapolation.h"

#include "acus/numeric/pieces.h"
#include "acus/numeric/simd.h"

namespace acus::numeric {
namespace {

using Differences = std::array<NodeVector, Extrapolation::most>;
using Missed = std::array<double, Extrapolation::most>;

// Replaces the differences of a range by the next ones. Returns the square of what each order missed the
// value by.
ACUS_KERNEL Missed advance_differences(Differences& difference, const NodeVector& value,
                                       const NodeVector& last, Range range) {
  Lane4 missed[Extrapolation::most] = {};
  for (std::size_t i = range.first; i < range.last; i += node_stride) {
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

void extrapolate(NodeVector& x, const Extrapolation& e, const Team& team) {
  for (int k = 0; k < e.order; ++k) add_scaled_into(x, 1.0, e.difference[k], team);
}

void learn(Extrapolation& e, const NodeVector& value, const NodeVector& last, const Team& team) {
  std::array<Missed, most_pieces> missed{};
  team.run(pieces_of(value.size()), [&](int piece) {
    missed[piece] = advance_differences(e.difference, value, last, piece_of(value.size(), piece));
  });
  for (int piece = 1; piece < pieces_of(value.size()); ++piece)
    for (int k = 0; k < Extrapolation::most; ++k) missed[0][k] += missed[piece][k];
  e.order = 1;
  for (int k = 1; k < Extrapolation::most; ++k)
    if (missed[0][k] < missed[0][e.order - 1]) e.order = k + 1;
}

}  // namespace acus::numeric
