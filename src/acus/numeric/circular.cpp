#include "acus/numeric/circular.h"

#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace acus::numeric {
namespace {

constexpr double quarter = std::numbers::pi / 2.0;

// Where an angle lies: `quadrant` quarter turns and a rest of at most an eighth of a turn.
struct Turned {
  int quadrant;
  double rest;
};

// pi/2 in three parts of 33, 33 and 53 bits, so that few quarter turns of the first two are exact (Cody and
// Waite, Software Manual for the Elementary Functions, 1980, 8.2).
Turned turned(double x) {
  constexpr double high = 0x1.921fb544p+0, middle = 0x1.0b4611a6p-34, low = 0x1.3198a2e037073p-69;
  constexpr double farthest = 1e8;  // beyond it quarter turns are no longer counted exactly
  if (!(std::abs(x) < farthest)) return {0, std::numeric_limits<double>::quiet_NaN()};
  const double turns = std::floor(x / quarter + 0.5);
  const double rest = ((x - turns * high) - turns * middle) - turns * low;
  return {static_cast<int>(turns - 4.0 * std::floor(turns / 4.0)), rest};
}

// 1 / (n (n - 1)) and 1 / n, since a division costs as much as the rest of a term.
struct Reciprocals {
  std::array<double, 50> of_pair{}, of{};
};
constexpr Reciprocals reciprocals = [] {
  Reciprocals r;
  for (std::size_t n = 2; n < r.of.size(); ++n) {
    r.of[n] = 1.0 / static_cast<double>(n);
    r.of_pair[n] = 1.0 / static_cast<double>(n * (n - 1));
  }
  return r;
}();

// Taylor's series, whose first term left out is below 1e-19 for |x| <= pi/4.
double sin_of_rest(double x) {
  const double s = x * x;
  double sum = 0.0;
  for (std::size_t n = 17; n >= 3; n -= 2) sum = s * reciprocals.of_pair[n] * (1.0 - sum);
  return x - x * sum;
}
double cos_of_rest(double x) {
  const double s = x * x;
  double sum = 0.0;
  for (std::size_t n = 18; n >= 4; n -= 2) sum = s * reciprocals.of_pair[n] * (1.0 - sum);
  // 1 - (s/2) (1 - sum), with what the first difference rounds away put back.
  const double half = 0.5 * s;
  const double rough = 1.0 - half;
  return rough + (((1.0 - rough) - half) + half * sum);
}

}  // namespace

double sin(double x) {
  const auto [quadrant, rest] = turned(x);
  const double size = quadrant % 2 == 0 ? sin_of_rest(rest) : cos_of_rest(rest);
  return quadrant < 2 ? size : -size;
}

double cos(double x) {
  const auto [quadrant, rest] = turned(x);
  const double size = quadrant % 2 == 0 ? cos_of_rest(rest) : sin_of_rest(rest);
  return quadrant == 0 || quadrant == 3 ? size : -size;
}

double tan(double x) { return sin(x) / cos(x); }

// Above 1 the other angle of the triangle; above tan(pi/8) what is missing to an eighth of a turn. For the
// rest 24 terms of Gregory's series leave less than 1e-19.
double atan(double x) {
  constexpr double tangent_of_sixteenth = std::numbers::sqrt2 - 1.0;
  const double t = std::abs(x);
  if (t > 1.0) return std::copysign(quarter - atan(1.0 / t), x);
  if (t > tangent_of_sixteenth) return std::copysign(0.5 * quarter - atan((1.0 - t) / (1.0 + t)), x);
  const double s = t * t;
  double sum = 0.0;
  for (std::size_t n = 49; n >= 3; n -= 2) sum = s * (reciprocals.of[n] - sum);
  return std::copysign(t - t * sum, x);
}

double asin(double x) { return atan(x / std::sqrt((1.0 - x) * (1.0 + x))); }

}  // namespace acus::numeric
