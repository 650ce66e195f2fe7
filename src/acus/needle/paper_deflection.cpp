#include "acus/needle/paper_deflection.h"

#include <cassert>
#include <cmath>
#include <limits>
#include <numbers>

#include "acus/numeric/elliptic.h"
#include "acus/numeric/root.h"

namespace acus::needle {

using std::numbers::pi;

// Eq. 12 reads K(sin(alpha/2)) = (pi/2) sqrt(F / F_e). With K(k) = pi / (2 agm(1, k')) and the complementary
// modulus k' = cos(alpha/2) this is
//   agm(1, cos(alpha/2)) = sqrt(F_e / F),
// which has one root in 0 < cos(alpha/2) <= 1 however large the load is: alpha tends to 180 degrees.
double end_slope(double load, double critical_load) {
  assert(load >= 0.0 && critical_load > 0.0);
  if (load <= critical_load) return 0.0;
  const double mean = std::sqrt(critical_load / load);
  const auto excess = [&](double c) { return numeric::arithmetic_geometric_mean(1.0, c) - mean; };
  const double least_cosine = std::numeric_limits<double>::min();  // 180 degrees to the last bit
  if (excess(least_cosine) >= 0.0) return pi;
  const double cosine = numeric::bracketed_root(excess, least_cosine, 1.0);
  return 2.0 * std::atan2(std::sqrt((1.0 - cosine) * (1.0 + cosine)), cosine);
}

double paper_amplitude(double span, double end_slope) {
  assert(end_slope >= 0.0 && end_slope < pi / 2.0);
  return span / pi * std::tan(end_slope);
}

double paper_shape(double x, double span, double end_slope) {
  return paper_amplitude(span, end_slope) * std::sin(pi * x / span);
}

}  // namespace acus::needle
