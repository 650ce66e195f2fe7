#include "acus/numeric/elliptic.h"

#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <numbers>

#include "acus/numeric/circular.h"

namespace acus::numeric {
namespace {

// c_n falls quadratically, so this many steps reach the last bit even for the modulus next to 1.
constexpr int max_steps = 12;

struct Means {
  double a, b, c;
};

// The sequence of arithmetic-geometric means that starts from a = 1, b = k', c = k.
struct Descent {
  std::array<Means, max_steps + 1> means;
  int last = 0;
  double complete_first = 0.0;
  double second_over_first = 0.0;  // E / K = 1 - sum of 2^(n-1) c_n^2
};

Descent descend(double modulus) {
  assert(modulus >= 0.0 && modulus < 1.0);
  Descent d;
  d.means[0] = {1.0, std::sqrt((1.0 - modulus) * (1.0 + modulus)), modulus};
  double weight = 0.5;
  double sum = weight * modulus * modulus;
  while (d.last < max_steps &&
         d.means[d.last].c > std::numeric_limits<double>::epsilon() * d.means[d.last].a) {
    const auto [a, b, c] = d.means[d.last];
    const double mean = 0.5 * (a + b);
    const Means next{mean, std::sqrt(a * b), c * c / (4.0 * mean)};
    weight *= 2.0;
    sum += weight * next.c * next.c;
    d.means[++d.last] = next;
  }
  d.complete_first = std::numbers::pi / (2.0 * d.means[d.last].a);
  d.second_over_first = 1.0 - sum;
  return d;
}

}  // namespace

double arithmetic_geometric_mean(double a, double b) {
  assert(a > 0.0 && b > 0.0);
  // The gap more than halves at first and is then squared: a thousandfold ratio of a to b costs few steps
  // more.
  for (int i = 0; i < 64 && std::abs(a - b) > std::numeric_limits<double>::epsilon() * a; ++i) {
    const double mean = 0.5 * (a + b);
    b = std::sqrt(a * b);
    a = mean;
  }
  return 0.5 * (a + b);
}

EllipticIntegrals complete_elliptic(double modulus) {
  const Descent d = descend(modulus);
  return {d.complete_first, d.complete_first * d.second_over_first};
}

EllipticIntegrals incomplete_elliptic(double phi, double modulus) {
  const Descent d = descend(modulus);
  double sum = 0.0;
  double scale = 1.0;
  for (int n = 0; n < d.last; ++n) {
    // tan(phi' - phi) = (b/a) tan(phi), written so that no quadrant is lost.
    const auto [a, b, c] = d.means[n];
    const double s = sin(phi);
    const double co = cos(phi);
    phi = 2.0 * phi - atan((a - b) * s * co / (a * co * co + b * s * s));
    scale *= 2.0;
    sum += d.means[n + 1].c * sin(phi);
  }
  const double first = phi / (scale * d.means[d.last].a);
  return {first, first * d.second_over_first + sum};
}

double jacobi_amplitude(double u, double modulus) {
  const Descent d = descend(modulus);
  double phi = std::ldexp(d.means[d.last].a * u, d.last);
  for (int n = d.last; n > 0; --n) phi = 0.5 * (phi + asin(d.means[n].c / d.means[n].a * sin(phi)));
  return phi;
}

}  // namespace acus::numeric
