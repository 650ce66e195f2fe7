// Rotations that follow the tissue: from those of the step before to those of this one.
//
// A rotation R is kept as a quaternion, x y z w, of any length, which is near one after a few corrections.
// With the gradient H = F - I of the displacement, B = F R^T = I + (R - I)^T + H R^T is symmetric when R is
// the rotation of F. What is left of it, B_32 - B_23 and so on, is (tr(S) I - S) w for a small turn w, S the
// symmetric part: a step of Newton's method for the polar factor on the rotations themselves, from a start
// that is already near. Terms of second order cancel: what a correction by w leaves is of the order of w^3.
// Nothing but what differs from the rest state is ever added up, so that rounding is a share of the
// displacement's gradient and of the turn, and tissue at rest has no stress whatever the precision.
#pragma once

#include "acus/tissue/element.h"

namespace acus::tissue {

// A correction below this, a square of radians, leaves 1e-12, or what rounding leaves of floats.
inline constexpr double tracked_turn_converged = 1e-8;
inline constexpr int tracked_turn_most = 4;
inline constexpr int turn_numbers = 4;

using numeric::RealOf;

// R - I, column by column.
template <class Lane>
ACUS_INLINE void turn_less_identity(Lane* r, const Lane* turn) {
  using Real = RealOf<Lane>;
  const Lane x = turn[0], y = turn[1], z = turn[2], w = turn[3];
  const Lane xx = x * x, yy = y * y, zz = z * z;
  const Lane s = Real{2} / (xx + yy + zz + w * w);
  const Lane sx = s * x, sy = s * y, sz = s * z;
  const Lane xy = sx * y, xz = sx * z, yz = sy * z, xw = sx * w, yw = sy * w, zw = sz * w;
  r[0] = -s * (yy + zz), r[1] = xy + zw, r[2] = xz - yw;
  r[3] = xy - zw, r[4] = -s * (xx + zz), r[5] = yz + xw;
  r[6] = xz + yw, r[7] = yz - xw, r[8] = -s * (xx + yy);
}

// q_i = g_i + (R - I) g_i
template <class Lane>
ACUS_INLINE void turn_gradients(Lane* q, const Lane* r, const Lane* g) {
  for (int i = 0; i < 3; ++i)
    for (int c = 0; c < 3; ++c)
      q[3 * i + c] = g[3 * i + c] + (r[c] * g[3 * i] + r[3 + c] * g[3 * i + 1] + r[6 + c] * g[3 * i + 2]);
}

// B - I = F R^T - I, from R - I and the displacement's gradient at rest, H = F - I.
template <class Lane>
ACUS_INLINE void stretch_less_identity(Lane* b, const Lane* r, const Lane* h) {
  for (int c = 0; c < 3; ++c)
    for (int k = 0; k < 3; ++k)
      b[3 * c + k] =
          r[3 * k + c] + (h[3 * c + k] + (h[k] * r[c] + h[3 + k] * r[3 + c] + h[6 + k] * r[6 + c]));
}

// Corrects the turn that gave B - I. `change` becomes the square of the angle. Returns a number above 0 where
// tr(S) I - S is positive definite by a margin, so that this is the nearest rotation and no other.
template <class Lane>
ACUS_INLINE Lane correct_turn(Lane* turn, const Lane* b, Lane& change) {
  using Real = RealOf<Lane>;
  constexpr Real half = 0.5, one = 1.0, two = 2.0;
  const Lane xy = half * (b[1] + b[3]), xz = half * (b[2] + b[6]), yz = half * (b[5] + b[7]);
  // K = tr(S) I - S and its minors
  const Lane k0 = two + (b[4] + b[8]), k1 = two + (b[0] + b[8]), k2 = two + (b[0] + b[4]);
  const Lane m00 = k1 * k2 - yz * yz, m11 = k0 * k2 - xz * xz, m22 = k0 * k1 - xy * xy;
  const Lane m01 = xz * yz + xy * k2, m02 = xy * yz + xz * k1, m12 = xy * xz + yz * k0;
  const Lane determinant = k0 * m00 - xy * m01 - xz * m02;
  const Lane ax = b[5] - b[7], ay = b[6] - b[2], az = b[1] - b[3];
  const Lane half_inverse = half / determinant;
  const Lane tx = half_inverse * (m00 * ax + m01 * ay + m02 * az);  // tangent of half the angle
  const Lane ty = half_inverse * (m01 * ax + m11 * ay + m12 * az);
  const Lane tz = half_inverse * (m02 * ax + m12 * ay + m22 * az);
  const Lane x = turn[0], y = turn[1], z = turn[2], w = turn[3];
  const Lane nx = x + tx * w + (ty * z - tz * y), ny = y + ty * w + (tz * x - tx * z);
  const Lane nz = z + tz * w + (tx * y - ty * x), nw = w - (tx * x + ty * y + tz * z);
  // Towards length one, from near it by the square of what is missing.
  const Lane scale = two / (one + (nx * nx + ny * ny + nz * nz + nw * nw));
  turn[0] = scale * nx, turn[1] = scale * ny, turn[2] = scale * nz, turn[3] = scale * nw;
  // At rest the trace of K is 6, its determinant 8.
  // As flat, Newton's method hardly converges; as small, B is lost in the rounding of B - I in floats.
  constexpr Real flattest = static_cast<Real>(1e-5), smallest = static_cast<Real>(1e-3);
  const Lane trace = k0 + k1 + k2, not_crushed = trace - smallest;
  const Lane by_determinant = determinant - flattest * trace * trace * trace;
  const Lane least = k0 < m22 ? k0 : m22;
  const Lane positive = least < not_crushed ? least : not_crushed;
  change = Real{4} * (tx * tx + ty * ty + tz * tz);
  return by_determinant < positive ? by_determinant : positive;
}

}  // namespace acus::tissue
