#include "acus/numeric/elementary.h"

#include <cassert>

namespace acus::numeric {

// Halved into [1, 2), then ln x = 2 artanh((x - 1) / (x + 1)) by its series.
double log(double x) {
  assert(x >= 1.0);
  constexpr double ln2 = 0.69314718055994530942;
  int halvings = 0;
  for (; x >= 2.0; x *= 0.5) ++halvings;
  const double y = (x - 1.0) / (x + 1.0), square = y * y;
  double sum = 0.0, power = 2.0 * y;
  for (int k = 1; k < 40; k += 2, power *= square) sum += power / k;
  return sum + halvings * ln2;
}

// Scaled by powers of eight into [1, 8), then Newton's method.
double cube_root(double x) {
  assert(x > 0.0);
  double scale = 1.0;
  for (; x < 1.0; x *= 8.0) scale *= 0.5;
  for (; x >= 8.0; x *= 0.125) scale *= 2.0;
  double y = 1.5;
  for (int step = 0; step < 7; ++step) y = (2.0 * y + x / (y * y)) / 3.0;
  return scale * y;
}

}  // namespace acus::numeric
