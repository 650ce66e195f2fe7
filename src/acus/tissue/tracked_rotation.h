// Rotations that follow the tissue: from those of the step before to those of this one.
//
// With q_i = R g_i from before, B = sum_i e_i q_i^T is F R^T, which is symmetric when R is the rotation of F.
// What is left of it, B_32 - B_23 and so on, is (tr(S) I - S) w for a small turn w, S the symmetric part: a
// step of Newton's method for the polar factor on the rotations themselves, from a start that is already near
// and without the rest state. Terms of second order cancel: what a correction by w leaves is of the order of
// w^3. The turn is Cayley's, exactly orthogonal, so that the q_i keep their lengths and angles to rounding.
#pragma once

#include "acus/tissue/element.h"

namespace acus::tissue {

// A correction below this, a square of radians, leaves 1e-12.
inline constexpr double tracked_turn_converged = 1e-8;
inline constexpr int tracked_turn_most = 4;

// Turns the q_i, which with the edges gave B. `change` becomes the square of the angle. Returns a number
// above 0 where tr(S) I - S is positive definite by a margin, so that this is the nearest rotation and no
// other.
template <class Lane>
ACUS_INLINE Lane correct_rotation(Lane* q, const Lane* b, Lane& change) {
  const Lane xx = b[0], yy = b[4], zz = b[8];
  const Lane xy = 0.5 * (b[1] + b[3]), xz = 0.5 * (b[2] + b[6]), yz = 0.5 * (b[5] + b[7]);
  // K = tr(S) I - S and its minors
  const Lane k0 = yy + zz, k1 = xx + zz, k2 = xx + yy;
  const Lane m00 = k1 * k2 - yz * yz, m11 = k0 * k2 - xz * xz, m22 = k0 * k1 - xy * xy;
  const Lane m01 = xz * yz + xy * k2, m02 = xy * yz + xz * k1, m12 = xy * xz + yz * k0;
  const Lane determinant = k0 * m00 - xy * m01 - xz * m02;
  const Lane ax = b[5] - b[7], ay = b[6] - b[2], az = b[1] - b[3];
  const Lane half_inverse = 0.5 / determinant;
  const Lane tx = half_inverse * (m00 * ax + m01 * ay + m02 * az);  // tangent of half the angle
  const Lane ty = half_inverse * (m01 * ax + m11 * ay + m12 * az);
  const Lane tz = half_inverse * (m02 * ax + m12 * ay + m22 * az);
  const Lane square = tx * tx + ty * ty + tz * tz;
  const Lane factor = 2.0 / (1.0 + square);
  for (int i = 0; i < 3; ++i) {
    const Lane x = q[3 * i], y = q[3 * i + 1], z = q[3 * i + 2];
    const Lane ux = x + (ty * z - tz * y), uy = y + (tz * x - tx * z), uz = z + (tx * y - ty * x);
    q[3 * i] = x + factor * (ty * uz - tz * uy);
    q[3 * i + 1] = y + factor * (tz * ux - tx * uz);
    q[3 * i + 2] = z + factor * (tx * uy - ty * ux);
  }
  // At rest the trace of K is 6, its determinant 8.
  constexpr double flattest = 1e-5;
  const Lane trace = k0 + k1 + k2;
  const Lane by_determinant = determinant - flattest * trace * trace * trace;
  const Lane least = k0 < m22 ? k0 : m22;
  const Lane positive = least < trace ? least : trace;
  change = 4.0 * square;
  return by_determinant < positive ? by_determinant : positive;
}

}  // namespace acus::tissue
