#include "acus/numeric/chebyshev.h"

#include <gtest/gtest.h>

#include <cmath>

namespace {

using namespace acus::numeric;

// The dropped terms of these functions fall at least threefold each.
constexpr double tolerance = 1.5 * chebyshev_truncation;
// The slope of T_n is at most n^2.
constexpr double slope_tolerance = 24 * 24 * tolerance;

TEST(Chebyshev, reproduces_an_analytic_function_and_its_slope) {
  const auto f = [](double x) { return 1.0 / (x + 2.0); };
  const ChebyshevSeries series = chebyshev_fit(f);
  EXPECT_LT(series.terms, 24);  // its terms fall by 2 + sqrt 3 each: the rest is dropped
  for (double x = -1.0; x <= 1.0; x += 0.05) {
    EXPECT_NEAR(value(series, x), f(x), tolerance);
    EXPECT_NEAR(value_and_slope(series, x).value, f(x), tolerance);
    EXPECT_NEAR(value_and_slope(series, x).slope, -f(x) * f(x), slope_tolerance);
  }
}

TEST(Chebyshev, integral_matches_the_antiderivative) {
  const ChebyshevSeries series = integral(chebyshev_fit([](double x) { return std::exp(x); }));
  for (double x = -1.0; x <= 1.0; x += 0.05)
    EXPECT_NEAR(value(series, x), std::exp(x) - std::exp(-1.0), tolerance);
  const ChebyshevSeries ramp = integral(chebyshev_fit([](double) { return 3.0; }));
  EXPECT_NEAR(value(ramp, 0.5), 4.5, tolerance);
}

// An even function of z is given as a function of x = 2 z^2 - 1.
TEST(Chebyshev, odd_integral_matches_the_antiderivative_of_an_even_function) {
  const ChebyshevSeries cosine = chebyshev_fit([](double x) { return std::cos(std::sqrt(0.5 * (x + 1.0))); });
  const ChebyshevSeries sine = odd_integral(cosine);
  for (double z = -1.0; z <= 1.0; z += 0.05) EXPECT_NEAR(odd_value(sine, z), std::sin(z), tolerance);
  const ChebyshevSeries square = odd_integral(chebyshev_fit([](double x) { return 0.5 * (x + 1.0); }));
  EXPECT_NEAR(odd_value(square, 0.6), 0.072, tolerance);
}

}  // namespace
