// Short Chebyshev series: a smooth function as sums and products only, so that its value is the same bits
// everywhere.
#pragma once

#include <array>
#include <cmath>
#include <numbers>

#include "acus/numeric/circular.h"

namespace acus::numeric {

inline constexpr int max_chebyshev_terms = 40;

// sum over n < terms of coefficient[n] T_n(x), -1 <= x <= 1; as an odd series, of coefficient[n] T_{2n+1}.
struct ChebyshevSeries {
  std::array<double, max_chebyshev_terms + 1> coefficient{};
  int terms = 0;
};

struct ValueAndSlope {
  double value;
  double slope;
};

// Trailing terms below this part of the largest one are dropped: well above rounding, far below any use.
inline constexpr double chebyshev_truncation = 1e-12;

// Interpolates an analytic f on [-1, 1] at the Chebyshev points.
template <class Function>
ChebyshevSeries chebyshev_fit(Function&& f) {
  constexpr int n = max_chebyshev_terms;
  std::array<double, n> sample;
  for (int j = 0; j < n; ++j) sample[j] = f(cos(std::numbers::pi * (j + 0.5) / n));
  ChebyshevSeries series;
  double largest = 0.0;
  for (int i = 0; i < n; ++i) {
    double sum = 0.0;
    for (int j = 0; j < n; ++j) sum += sample[j] * cos(std::numbers::pi * i * (j + 0.5) / n);
    series.coefficient[i] = sum * (i == 0 ? 1.0 : 2.0) / n;
    largest = std::fmax(largest, std::abs(series.coefficient[i]));
  }
  series.terms = n;
  const double least = chebyshev_truncation * largest;
  while (series.terms > 1 && std::abs(series.coefficient[series.terms - 1]) < least) --series.terms;
  return series;
}

// The value at x, by Clenshaw's recurrence.
double value(const ChebyshevSeries& series, double x);
ValueAndSlope value_and_slope(const ChebyshevSeries& series, double x);
// The series of the integral from -1 to x.
ChebyshevSeries integral(const ChebyshevSeries& series);

// An even function of z in [-1, 1] is a series in x = T_2(z) = 2 z^2 - 1, since T_n(T_2(z)) = T_{2n}(z). Its
// integral from z = 0 is odd: the coefficients of T_{2n+1}(z), to be read with odd_value.
ChebyshevSeries odd_integral(const ChebyshevSeries& even);
double odd_value(const ChebyshevSeries& odd, double z);

}  // namespace acus::numeric
