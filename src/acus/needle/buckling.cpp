#include "acus/needle/buckling.h"

#include <cassert>
#include <cmath>
#include <numbers>

#include "acus/numeric/circular.h"
#include "acus/numeric/root.h"

namespace acus::needle {

using std::numbers::pi;

double critical_load_factor(Support support) {
  switch (support) {
    case Support::pinned_pinned:
      return 1.0;
    case Support::clamped_pinned:
      return clamped_pinned_root * clamped_pinned_root / (pi * pi);
    case Support::clamped_clamped:
      return 4.0;
    case Support::clamped_free:
      return 0.25;
  }
  assert(false);
  return 0.0;
}

double critical_load(double bending_rigidity, double free_length, Support support) {
  assert(bending_rigidity > 0.0 && free_length > 0.0);
  return critical_load_factor(support) * pi * pi * bending_rigidity / (free_length * free_length);
}

// Small bows of the column solve EI w'''' + P w'' = 0. With z = l sqrt(P / EI) and w = w' = 0 at the hub, x =
// 0:
//   w = A (sin(z x/l) - z x/l) + B (1 - cos(z x/l)).
// No moment at the tip, w''(l) = 0:                A = cos z, B = sin z (up to a common factor).
// The spring carries the shear, EI w''' + P w' = k w at x = l:
//   -(EI / l^3) z^3 cos z = k (sin z - z cos z).
// k = 0 gives cos z = 0 (clamped-free), k = infinity gives tan z = z (clamped-pinned); the root lies between.
double critical_load_with_lateral_spring(double bending_rigidity, double free_length,
                                         double lateral_stiffness) {
  assert(bending_rigidity > 0.0 && free_length > 0.0 && lateral_stiffness >= 0.0);
  const double bending_stiffness = bending_rigidity / (free_length * free_length * free_length);
  const auto imbalance = [&](double z) {
    return bending_stiffness * z * z * z * numeric::cos(z) +
           lateral_stiffness * (numeric::sin(z) - z * numeric::cos(z));
  };
  const double free_root = pi / 2.0;
  if (lateral_stiffness == 0.0) return critical_load(bending_rigidity, free_length, Support::clamped_free);
  const double z = numeric::bracketed_root(imbalance, free_root, clamped_pinned_root);
  return bending_rigidity * z * z / (free_length * free_length);
}

}  // namespace acus::needle
