// What elements do on their rotated gradients q_i = R g_i, many side by side.
//
// All of it is in the frame of space: the gradient of a nodal field y is G = sum_i y_i q_i^T, that of the
// positions is F R^T, and a stress gives corner i the force - V sigma q_i. Matrices are column by column:
// entry (r, c) at 3 c + r; symmetric ones are xx yy zz xy xz yz. Corner 0 gives what the others get.
#pragma once

#include "acus/tissue/lanes.h"

namespace acus::tissue {

// The gradient of a field with the edges y_i - y_0, i = 1 .. 3.
template <class Lane>
ACUS_INLINE void gradient_of(Lane* g, const Lane* edge, const Lane* q) {
  for (int c = 0; c < 3; ++c)
    for (int r = 0; r < 3; ++r)
      g[3 * c + r] = edge[r] * q[c] + edge[3 + r] * q[3 + c] + edge[6 + r] * q[6 + c];
}

// V times the stress to a gradient: V (lambda tr(G) I + mu (G + G^T)).
template <class Lane>
ACUS_INLINE void stress_of(Lane* s, const Lane* g, Lane trace, Lane mu_v, Lane lambda_v) {
  const Lane two_mu = mu_v + mu_v, bulk = lambda_v * trace;
  s[0] = two_mu * g[0] + bulk, s[1] = two_mu * g[4] + bulk, s[2] = two_mu * g[8] + bulk;
  s[3] = mu_v * (g[1] + g[3]), s[4] = mu_v * (g[2] + g[6]), s[5] = mu_v * (g[5] + g[7]);
}

template <class Lane>
ACUS_INLINE void balance_corner_0(Lane (*force)[4]) {
  for (int c = 0; c < 3; ++c) force[0][c] = -(force[1][c] + force[2][c] + force[3][c]);
}

// What V times a symmetric stress asks of the corners: f_i = V sigma q_i.
template <class Lane>
ACUS_INLINE void corner_forces(Lane (*force)[4], const Lane* s, const Lane* q) {
  for (int i = 0; i < 3; ++i) {
    const Lane qx = q[3 * i], qy = q[3 * i + 1], qz = q[3 * i + 2];
    force[i + 1][0] = s[0] * qx + s[3] * qy + s[4] * qz;
    force[i + 1][1] = s[3] * qx + s[1] * qy + s[5] * qz;
    force[i + 1][2] = s[4] * qx + s[5] * qy + s[2] * qz;
  }
  balance_corner_0(force);
}

// The same for a pressure, as V times it.
template <class Lane>
ACUS_INLINE void corner_forces_of_pressure(Lane (*force)[4], Lane pressure_v, const Lane* q) {
  for (int i = 0; i < 3; ++i)
    for (int c = 0; c < 3; ++c) force[i + 1][c] = pressure_v * q[3 * i + c];
  balance_corner_0(force);
}

// The edges of a field of padded node vectors from a pair's first node to its others.
template <class Real, class Lane>
ACUS_INLINE void gather_edges(Lane* edge, const Real* field, const Offsets* offsets) {
  Lane origin[4], node[4];
  gather_node(origin, field, offsets, 0);
  ACUS_UNROLL
  for (int i = 0; i < pair_nodes - 1; ++i) {
    gather_node(node, field, offsets, i + 1);
    for (int c = 0; c < 3; ++c) edge[3 * i + c] = node[c] - origin[c];
  }
}

// The same of a field in double, for lanes of either precision: what floats lose is a share of the edges and
// not of the field.
template <class Lane>
ACUS_INLINE void gather_narrowed_edges(Lane* edge, const double* field, const Offsets* offsets) {
  if constexpr (std::is_same_v<numeric::RealOf<Lane>, double>) {
    gather_edges(edge, field, offsets);
  } else {
    using Half = numeric::LaneOf<double, sizeof(Lane)>;
    constexpr int numbers = 3 * (pair_nodes - 1);
    Half half[2][numbers];
    for (int i = 0; i < 2; ++i) gather_edges(half[i], field, offsets + i * lanes_in<double, Half>);
    for (int k = 0; k < numbers; ++k) edge[k] = numeric::narrowed(half[0][k], half[1][k]);
  }
}

// Which of a pair's nodes is a corner of one of its sides: the other side sees the shared face from behind.
inline constexpr int node_of_corner(int side, int corner) {
  return side == 0 || corner == 0 ? corner : corner == 3 ? 4 : 3 - corner;
}
template <class Lane>
ACUS_INLINE void edges_of_side(Lane* of_side, const Lane* edge, int side) {
  for (int i = 0; i < 3; ++i)
    for (int c = 0; c < 3; ++c) of_side[3 * i + c] = edge[3 * (node_of_corner(side, i + 1) - 1) + c];
}
// To the nodes of a pair what its sides ask of their corners, one after the other.
template <class Lane>
ACUS_INLINE void put_corners(Lane (*node)[4], const Lane (*corner)[4], int side) {
  for (int i = 0; i < 4; ++i) {
    const int at = node_of_corner(side, i);
    const bool is_first = side == 0 || i == 3;
    for (int c = 0; c < 4; ++c) node[at][c] = is_first ? corner[i][c] : node[at][c] + corner[i][c];
  }
}

}  // namespace acus::tissue
