// The rotation in a deformation gradient.
#pragma once

#include "acus/base/vec.h"
#include "acus/numeric/simd.h"

namespace acus::numeric {

// The proper rotation R (det R = +1) nearest to F, i.e. the maximiser of tr(R^T F). For det F > 0 it is the
// orthogonal factor of the polar decomposition; for inverted F the axis of least stretch is the one
// reflected; for flat, line-like or zero F, where it is not unique, one maximiser is returned. Finite F in,
// finite R out.
Mat3 rotation_of(const Mat3& F);

// Writes the cofactor matrix of m (nine entries, column by column) and returns det m.
template <class T>
ACUS_INLINE T cofactor_into(T* c, const T* m) {
  for (int j = 0; j < 3; ++j) {
    const T* a = m + 3 * ((j + 1) % 3);
    const T* b = m + 3 * ((j + 2) % 3);
    c[3 * j + 0] = a[1] * b[2] - a[2] * b[1];
    c[3 * j + 1] = a[2] * b[0] - a[0] * b[2];
    c[3 * j + 2] = a[0] * b[1] - a[1] * b[0];
  }
  return m[0] * c[0] + m[1] * c[1] + m[2] * c[2];
}

// One correction of Newton's iteration R <- (R + R^-T)/2 from R = F (Higham 1986), on a plain or a vector
// type T. It converges quadratically to the polar factor of a regular F. Returns the sum of squares of the
// change; `det` is the determinant before it. For singular F it gives no number, for inverted F a reflection:
// callers check with `newton_polar_holds`.
template <class T>
ACUS_INLINE T newton_polar_step(T* r, T& det) {
  T c[9];
  det = cofactor_into(c, r);
  const T half_inverse = 0.5 / det;
  T change = det - det;
  for (int i = 0; i < 9; ++i) {
    const T next = 0.5 * r[i] + half_inverse * c[i];
    const T d = next - r[i];
    change += d * d;
    r[i] = next;
  }
  return change;
}

// A correction below this leaves an error of its square: the result is exact to rounding.
inline constexpr double newton_polar_converged = 1e-16;  // sum of squares, i.e. 1e-8 in an entry
inline constexpr int newton_polar_max_steps = 10;

// Whether the iteration can be trusted from F, given det F and |F|^2: nearer to singular than this, the sign
// of the determinant and the cofactors drown in rounding, and it may end at a reflection.
inline bool newton_polar_holds(double det, double norm_squared) {
  constexpr double flattest = 1e-6;  // det / |F|^3: its rounding error is some 1e-10 of it
  return det > 0.0 && det * det > flattest * flattest * norm_squared * norm_squared * norm_squared;
}

}  // namespace acus::numeric
