// Pieces of long vectors, which several threads may work on. How a vector is cut depends on its length alone,
// and sums over the pieces are added in their order, so that threads change no bits.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

#include "acus/base/team.h"

namespace acus::numeric {

struct Range {
  std::size_t first = 0, last = 0;  // without `last`
  std::size_t size() const { return last - first; }
};

// In numbers, four to a node.
inline constexpr int most_pieces = 8;
inline constexpr std::size_t shortest_cut = 5000;  // below it the work takes no longer than the handing out
inline constexpr std::size_t cut_step = 64;        // cuts are at its multiples, so that nodes stay whole

inline int pieces_of(std::size_t size) { return size < shortest_cut ? 1 : most_pieces; }
inline Range piece_of(std::size_t size, int piece) {
  const auto pieces = static_cast<std::size_t>(pieces_of(size)), at = static_cast<std::size_t>(piece);
  const std::size_t share = (size / pieces + cut_step - 1) / cut_step * cut_step;
  return {at * share, at + 1 == pieces ? size : (at + 1) * share};
}

// f(range) for each piece.
template <class F>
void each_piece(std::size_t size, const Team& team, const F& f) {
  team.run(pieces_of(size), [&](int piece) { f(piece_of(size, piece)); });
}
// The sum of what f(range) returns.
template <class F>
double sum_of_pieces(std::size_t size, const Team& team, const F& f) {
  std::array<double, most_pieces> part{};
  team.run(pieces_of(size), [&](int piece) { part[piece] = f(piece_of(size, piece)); });
  double sum = part[0];
  for (int piece = 1; piece < pieces_of(size); ++piece) sum += part[piece];
  return sum;
}

}  // namespace acus::numeric
