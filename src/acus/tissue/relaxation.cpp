#include "acus/tissue/relaxation.h"

#include <algorithm>

namespace acus::tissue {
namespace {

// Sums and products alone, for the same bits on every machine (numeric/circular.h).
struct Decay {
  double kept = 1.0;   // exp(-x)
  double taken = 1.0;  // (1 - exp(-x)) / x
};

// By the series of the mean (1 - exp(-x)) / x of a small x, doubled until it is the whole one: no
// differences, so that no step is too short or too long.
Decay decay(double x) {
  constexpr double small = 0.25;
  constexpr int terms = 14;  // 0.25^14 / 15! is nothing beside 1
  int doublings = 0;
  for (; x > small; x *= 0.5) ++doublings;
  Decay d;
  double mean = 1.0;
  for (int k = terms; k > 1; --k) mean = 1.0 - mean * x / k;
  d.taken = mean;
  d.kept = 1.0 - x * mean;
  for (; doublings > 0; --doublings) {
    d.taken *= 0.5 * (1.0 + d.kept);
    d.kept *= d.kept;
  }
  return d;
}

// What the dashpot spends on a unit strain that a step brings to a spring at rest:
// (x - (1 - a) (3 - a) / 2) / x^2 = sum over k >= 3 of (-1)^(k+1) (2^(k-1) - 2) x^(k-2) / k!.
double spent_on_strain(double x, double a) {
  if (x > 1.0) return (1.0 - 0.5 * (1.0 - a) * (3.0 - a) / x) / x;
  constexpr int terms = 24;
  double sum = 0.0, power = x / 6.0, two = 4.0, sign = 1.0;  // x^(k-2) / k! and 2^(k-1) for k = 3
  for (int k = 3; k < terms; ++k) {
    sum += sign * (two - 2.0) * power;
    power *= x / (k + 1);
    two *= 2.0;
    sign = -sign;
  }
  return sum;
}

}  // namespace

RelaxationStep relaxation_step(const Relaxation& relaxation, double h) {
  RelaxationStep s;
  if (relaxation.share == 0.0) return s;
  const double x = h / relaxation.time;
  const auto [a, b] = decay(x);
  s.modulus = relaxation.share / (1.0 - relaxation.share);
  s.kept = a;
  s.taken = b;
  s.spent = 0.5 * x * b * (1.0 + a);
  s.lead = b / (1.0 + a);
  s.rest = std::max(spent_on_strain(x, a) - s.spent * s.lead * s.lead, 0.0);
  return s;
}

}  // namespace acus::tissue
