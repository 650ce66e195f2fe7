#include "acus/numeric/chebyshev.h"

namespace acus::numeric {
namespace {

struct Tail {
  double first;   // of T_0 (or T_1)
  double second;  // of T_1 (or T_3)
};

// Clenshaw's downward recurrence b_n = c_n + 2 x b_{n+1} - b_{n+2}, down to b_0 and b_1.
Tail clenshaw(const ChebyshevSeries& series, double x) {
  Tail b{0.0, 0.0};
  for (int n = series.terms - 1; n >= 0; --n)
    b = {series.coefficient[n] - b.second + 2.0 * x * b.first, b.first};
  return b;
}

}  // namespace

double value(const ChebyshevSeries& series, double x) {
  const Tail b = clenshaw(series, x);
  return b.first - x * b.second;
}

ValueAndSlope value_and_slope(const ChebyshevSeries& series, double x) {
  // The recurrence and its derivative with respect to x, side by side.
  Tail b{0.0, 0.0};
  Tail slope{0.0, 0.0};
  for (int n = series.terms - 1; n >= 0; --n) {
    slope = {2.0 * b.first - slope.second + 2.0 * x * slope.first, slope.first};
    b = {series.coefficient[n] - b.second + 2.0 * x * b.first, b.first};
  }
  return {b.first - x * b.second, slope.first - x * slope.second - b.second};
}

ChebyshevSeries integral(const ChebyshevSeries& series) {
  // The integral of T_n is T_{n+1} / (2 (n+1)) - T_{n-1} / (2 (n-1)); T_0 gives T_1 and T_1 gives T_2 / 4.
  ChebyshevSeries result;
  result.terms = series.terms + 1;
  const auto coefficient = [&](int n) { return n < series.terms ? series.coefficient[n] : 0.0; };
  double at_minus_one = 0.0;
  for (int n = 1; n < result.terms; ++n) {
    const double below = n == 1 ? 2.0 * coefficient(0) : coefficient(n - 1);
    result.coefficient[n] = (below - coefficient(n + 1)) / (2.0 * n);
    at_minus_one += n % 2 == 0 ? result.coefficient[n] : -result.coefficient[n];
  }
  result.coefficient[0] = -at_minus_one;
  return result;
}

ChebyshevSeries odd_integral(const ChebyshevSeries& even) {
  // The same rule for T_{2n}: T_{2n+1} gathers from T_{2n} and T_{2n+2}. No constant: every odd T vanishes at
  // 0.
  ChebyshevSeries odd;
  odd.terms = even.terms;
  const auto coefficient = [&](int n) { return n < even.terms ? even.coefficient[n] : 0.0; };
  for (int n = 0; n < odd.terms; ++n) {
    const double below = n == 0 ? 2.0 * coefficient(0) : coefficient(n);
    odd.coefficient[n] = (below - coefficient(n + 1)) / (2.0 * (2 * n + 1));
  }
  return odd;
}

double odd_value(const ChebyshevSeries& odd, double z) {
  // T_{2n+1} obeys the same recurrence in x = T_2(z), from T_1 = T_{-1} = z.
  const Tail b = clenshaw(odd, 2.0 * z * z - 1.0);
  return z * (b.first - b.second);
}

}  // namespace acus::numeric
