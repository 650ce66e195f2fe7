#include "acus/numeric/logarithm.h"

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

}  // namespace acus::numeric
