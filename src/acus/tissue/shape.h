// The linear tetrahedron (paper Eq. 1-2).
#pragma once

#include <array>

#include "acus/base/vec.h"

namespace acus::tissue {

// Inside a tetrahedron u(x) = sum_i N_i(x) u_i (Eq. 1) with linear N_i, so the strain needs only the constant
// gradients g_i = dN_i/dx: the deformation gradient is F = sum_i x_i g_i^T, and Eq. 2's B_e is made of the
// g_i.
struct Shape {
  std::array<Vec3, 4> gradient;  // 1/m, sum to zero
  double volume = 0.0;           // m^3
};

// Corners at rest, m, with positive orientation and volume.
inline Shape shape_of(const Vec3& x0, const Vec3& x1, const Vec3& x2, const Vec3& x3) {
  Mat3 edges;
  edges << x1 - x0, x2 - x0, x3 - x0;
  const Mat3 inverse = edges.inverse();
  Shape shape;
  shape.volume = edges.determinant() / 6.0;
  for (int i = 0; i < 3; ++i) shape.gradient[i + 1] = inverse.row(i);
  shape.gradient[0] = -(shape.gradient[1] + shape.gradient[2] + shape.gradient[3]);
  return shape;
}

}  // namespace acus::tissue
