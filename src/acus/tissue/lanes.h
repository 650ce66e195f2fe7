// Elements side by side: how a node's numbers of each go into lanes, and come back.
#pragma once

#include "acus/numeric/node_vector.h"
#include "acus/numeric/simd.h"
#include "acus/tissue/tissue_model.h"

namespace acus::tissue {

static_assert(batch_pairs == numeric::lane_count<float>);

using numeric::lane_count;
using numeric::NodeLane;

// Numbers x y z and a fourth of eight or sixteen node vectors, turned about: out[c][l] = node[l][c].
ACUS_INLINE void into_lanes(numeric::Lane8* out, const numeric::Lane4* node) {
  numeric::Lane4 part[2][4];
  for (int h = 0; h < 2; ++h) {
    const numeric::Lane4* n = node + 4 * h;
    const auto low01 = __builtin_shufflevector(n[0], n[1], 0, 4, 2, 6);
    const auto low23 = __builtin_shufflevector(n[2], n[3], 0, 4, 2, 6);
    const auto high01 = __builtin_shufflevector(n[0], n[1], 1, 5, 3, 7);
    const auto high23 = __builtin_shufflevector(n[2], n[3], 1, 5, 3, 7);
    part[h][0] = __builtin_shufflevector(low01, low23, 0, 1, 4, 5);
    part[h][1] = __builtin_shufflevector(high01, high23, 0, 1, 4, 5);
    part[h][2] = __builtin_shufflevector(low01, low23, 2, 3, 6, 7);
    part[h][3] = __builtin_shufflevector(high01, high23, 2, 3, 6, 7);
  }
  for (int c = 0; c < 4; ++c)
    out[c] = __builtin_shufflevector(part[0][c], part[1][c], 0, 1, 2, 3, 4, 5, 6, 7);
}

// The way back.
ACUS_INLINE void out_of_lanes(numeric::Lane4* node, const numeric::Lane8* in) {
  numeric::Lane4 part[2][4];
  for (int c = 0; c < 4; ++c) {
    part[0][c] = __builtin_shufflevector(in[c], in[c], 0, 1, 2, 3);
    part[1][c] = __builtin_shufflevector(in[c], in[c], 4, 5, 6, 7);
  }
  for (int h = 0; h < 2; ++h) {
    const numeric::Lane4* p = part[h];
    const auto even_xy = __builtin_shufflevector(p[0], p[1], 0, 4, 2, 6);
    const auto odd_xy = __builtin_shufflevector(p[0], p[1], 1, 5, 3, 7);
    const auto even_zw = __builtin_shufflevector(p[2], p[3], 0, 4, 2, 6);
    const auto odd_zw = __builtin_shufflevector(p[2], p[3], 1, 5, 3, 7);
    node[4 * h] = __builtin_shufflevector(even_xy, even_zw, 0, 1, 4, 5);
    node[4 * h + 1] = __builtin_shufflevector(odd_xy, odd_zw, 0, 1, 4, 5);
    node[4 * h + 2] = __builtin_shufflevector(even_xy, even_zw, 2, 3, 6, 7);
    node[4 * h + 3] = __builtin_shufflevector(odd_xy, odd_zw, 2, 3, 6, 7);
  }
}

// Floats: quarters side by side, each a 4x4 matrix that is turned about its diagonal. Its own inverse.
ACUS_INLINE void turn_quarters(numeric::Lane16f* out, const numeric::Lane16f* in) {
  using numeric::Lane16f;
  const auto low = [](Lane16f a, Lane16f b) ACUS_INLINED {
    return __builtin_shufflevector(a, b, 0, 16, 1, 17, 4, 20, 5, 21, 8, 24, 9, 25, 12, 28, 13, 29);
  };
  const auto high = [](Lane16f a, Lane16f b) ACUS_INLINED {
    return __builtin_shufflevector(a, b, 2, 18, 3, 19, 6, 22, 7, 23, 10, 26, 11, 27, 14, 30, 15, 31);
  };
  const auto first = [](Lane16f a, Lane16f b) ACUS_INLINED {
    return __builtin_shufflevector(a, b, 0, 1, 16, 17, 4, 5, 20, 21, 8, 9, 24, 25, 12, 13, 28, 29);
  };
  const auto second = [](Lane16f a, Lane16f b) ACUS_INLINED {
    return __builtin_shufflevector(a, b, 2, 3, 18, 19, 6, 7, 22, 23, 10, 11, 26, 27, 14, 15, 30, 31);
  };
  const Lane16f low01 = low(in[0], in[1]), low23 = low(in[2], in[3]);
  const Lane16f high01 = high(in[0], in[1]), high23 = high(in[2], in[3]);
  out[0] = first(low01, low23);
  out[1] = second(low01, low23);
  out[2] = first(high01, high23);
  out[3] = second(high01, high23);
}

ACUS_INLINE void into_lanes(numeric::Lane16f* out, const numeric::Lane4f* node) {
  numeric::Lane16f row[4];  // quarter q of row j is node 4 q + j
  for (int j = 0; j < 4; ++j) {
    const auto first = __builtin_shufflevector(node[j], node[4 + j], 0, 1, 2, 3, 4, 5, 6, 7);
    const auto second = __builtin_shufflevector(node[8 + j], node[12 + j], 0, 1, 2, 3, 4, 5, 6, 7);
    row[j] = __builtin_shufflevector(first, second, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);
  }
  turn_quarters(out, row);
}

ACUS_INLINE void out_of_lanes(numeric::Lane4f* node, const numeric::Lane16f* in) {
  numeric::Lane16f row[4];
  turn_quarters(row, in);
  for (int j = 0; j < 4; ++j) {
    node[j] = __builtin_shufflevector(row[j], row[j], 0, 1, 2, 3);
    node[4 + j] = __builtin_shufflevector(row[j], row[j], 4, 5, 6, 7);
    node[8 + j] = __builtin_shufflevector(row[j], row[j], 8, 9, 10, 11);
    node[12 + j] = __builtin_shufflevector(row[j], row[j], 12, 13, 14, 15);
  }
}

// Eight floats: two such quarters.
ACUS_INLINE void turn_quarters(numeric::Lane8f* out, const numeric::Lane8f* in) {
  const auto low01 = __builtin_shufflevector(in[0], in[1], 0, 8, 1, 9, 4, 12, 5, 13);
  const auto low23 = __builtin_shufflevector(in[2], in[3], 0, 8, 1, 9, 4, 12, 5, 13);
  const auto high01 = __builtin_shufflevector(in[0], in[1], 2, 10, 3, 11, 6, 14, 7, 15);
  const auto high23 = __builtin_shufflevector(in[2], in[3], 2, 10, 3, 11, 6, 14, 7, 15);
  out[0] = __builtin_shufflevector(low01, low23, 0, 1, 8, 9, 4, 5, 12, 13);
  out[1] = __builtin_shufflevector(low01, low23, 2, 3, 10, 11, 6, 7, 14, 15);
  out[2] = __builtin_shufflevector(high01, high23, 0, 1, 8, 9, 4, 5, 12, 13);
  out[3] = __builtin_shufflevector(high01, high23, 2, 3, 10, 11, 6, 7, 14, 15);
}
ACUS_INLINE void into_lanes(numeric::Lane8f* out, const numeric::Lane4f* node) {
  numeric::Lane8f row[4];
  for (int j = 0; j < 4; ++j) row[j] = __builtin_shufflevector(node[j], node[4 + j], 0, 1, 2, 3, 4, 5, 6, 7);
  turn_quarters(out, row);
}
ACUS_INLINE void out_of_lanes(numeric::Lane4f* node, const numeric::Lane8f* in) {
  numeric::Lane8f row[4];
  turn_quarters(row, in);
  for (int j = 0; j < 4; ++j) {
    node[j] = __builtin_shufflevector(row[j], row[j], 0, 1, 2, 3);
    node[4 + j] = __builtin_shufflevector(row[j], row[j], 4, 5, 6, 7);
  }
}

// Four floats: one such quarter, a node's numbers to a lane and back.
ACUS_INLINE void into_lanes(numeric::Lane4f* out, const numeric::Lane4f* node) {
  const auto low01 = __builtin_shufflevector(node[0], node[1], 0, 4, 1, 5);
  const auto low23 = __builtin_shufflevector(node[2], node[3], 0, 4, 1, 5);
  const auto high01 = __builtin_shufflevector(node[0], node[1], 2, 6, 3, 7);
  const auto high23 = __builtin_shufflevector(node[2], node[3], 2, 6, 3, 7);
  out[0] = __builtin_shufflevector(low01, low23, 0, 1, 4, 5);
  out[1] = __builtin_shufflevector(low01, low23, 2, 3, 6, 7);
  out[2] = __builtin_shufflevector(high01, high23, 0, 1, 4, 5);
  out[3] = __builtin_shufflevector(high01, high23, 2, 3, 6, 7);
}
ACUS_INLINE void out_of_lanes(numeric::Lane4f* node, const numeric::Lane4f* in) { into_lanes(node, in); }

// Four doubles.
ACUS_INLINE void into_lanes(numeric::Lane4* out, const numeric::Lane4* node) {
  const auto low01 = __builtin_shufflevector(node[0], node[1], 0, 4, 2, 6);
  const auto low23 = __builtin_shufflevector(node[2], node[3], 0, 4, 2, 6);
  const auto high01 = __builtin_shufflevector(node[0], node[1], 1, 5, 3, 7);
  const auto high23 = __builtin_shufflevector(node[2], node[3], 1, 5, 3, 7);
  out[0] = __builtin_shufflevector(low01, low23, 0, 1, 4, 5);
  out[1] = __builtin_shufflevector(high01, high23, 0, 1, 4, 5);
  out[2] = __builtin_shufflevector(low01, low23, 2, 3, 6, 7);
  out[3] = __builtin_shufflevector(high01, high23, 2, 3, 6, 7);
}
ACUS_INLINE void out_of_lanes(numeric::Lane4* node, const numeric::Lane4* in) { into_lanes(node, in); }

// Two doubles.
ACUS_INLINE void into_lanes(numeric::Lane2* out, const numeric::Lane4* node) {
  out[0] = __builtin_shufflevector(node[0], node[1], 0, 4);
  out[1] = __builtin_shufflevector(node[0], node[1], 1, 5);
  out[2] = __builtin_shufflevector(node[0], node[1], 2, 6);
  out[3] = __builtin_shufflevector(node[0], node[1], 3, 7);
}
ACUS_INLINE void out_of_lanes(numeric::Lane4* node, const numeric::Lane2* in) {
  for (int l = 0; l < 2; ++l) node[l] = numeric::Lane4{in[0][l], in[1][l], in[2][l], in[3][l]};
}

template <class Real, class Lane>
inline constexpr int lanes_in = sizeof(Lane) / sizeof(Real);

// Node `i` of the pairs, from and to a field of padded node vectors: four numbers each. `offsets` are those
// of TissueModel.
template <class Real, class Lane>
ACUS_INLINE void gather_node(Lane* out, const Real* field, const Offsets* offsets, int i) {
  NodeLane<Real> node[lanes_in<Real, Lane>];
  ACUS_UNROLL
  for (int l = 0; l < lanes_in<Real, Lane>; ++l) node[l] = numeric::load4(field + offsets[l][i]);
  into_lanes(out, node);
}
template <class Real>
ACUS_INLINE void add_node(Real* field, const Offsets* offsets, int i, const numeric::LaneOf<Real, 64>* in) {
  NodeLane<Real> node[lane_count<Real>];
  out_of_lanes(node, in);
  ACUS_UNROLL
  for (int l = 0; l < lane_count<Real>; ++l) {
    Real* at = field + offsets[l][i];
    numeric::store4(at, numeric::load4(at) + node[l]);
  }
}
// Adds the corners of a batch that comes in parts in the order in which add_node would: node by node,
// and not part by part. A batch in one part is added at once.
template <class Real, class Lane>
class BatchSum {
 public:
  ACUS_INLINE BatchSum(Real* field, const Offsets* offsets) : field_(field), offsets_(offsets) {}
  ACUS_INLINE void take(int part, int i, const Lane* in) {
    if constexpr (whole)
      add_node(field_, offsets_, i, in);
    else
      out_of_lanes(node_[i] + part * lanes_in<Real, Lane>, in);
  }
  ACUS_INLINE void finish() const {
    if constexpr (!whole)
      for (int i = 0; i < pair_nodes; ++i)
        for (int l = 0; l < lane_count<Real>; ++l) {
          Real* at = field_ + offsets_[l][i];
          numeric::store4(at, numeric::load4(at) + node_[i][l]);
        }
  }

 private:
  static constexpr bool whole = lanes_in<Real, Lane> == lane_count<Real>;
  Real* field_;
  const Offsets* offsets_;
  NodeLane<Real> node_[pair_nodes][whole ? 1 : lane_count<Real>];
};
// The sums over the four corners of either side.
template <class Real, class Lane>
ACUS_INLINE void sum_corners(Lane (*out)[4], const Real* field, const Offsets* offsets) {
  NodeLane<Real> node[2][lanes_in<Real, Lane>];
  ACUS_UNROLL
  for (int l = 0; l < lanes_in<Real, Lane>; ++l) {
    const Offsets& t = offsets[l];
    const NodeLane<Real> face =
        (numeric::load4(field + t[0]) + numeric::load4(field + t[1])) + numeric::load4(field + t[2]);
    for (int side = 0; side < 2; ++side) node[side][l] = face + numeric::load4(field + t[3 + side]);
  }
  for (int side = 0; side < 2; ++side) into_lanes(out[side], node[side]);
}

}  // namespace acus::tissue
