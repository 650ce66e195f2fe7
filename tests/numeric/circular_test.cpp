#include "acus/numeric/circular.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <random>

namespace {

namespace numeric = acus::numeric;
using std::numbers::pi;

// Distance in units of the last place of the right answer.
double units_off(double answer, double right) {
  const double unit = std::nextafter(std::abs(right), INFINITY) - std::abs(right);
  return std::abs(answer - right) / unit;
}

// Two roundings of the rest of an angle and one of the answer are at most one unit and a half; the library of
// C adds its own half. The other bounds are those that the header promises.
TEST(Circular, agrees_with_the_c_library_to_the_last_places) {
  std::mt19937 random(1);
  for (const double reach : {1e-6, 0.1, 1.0, 10.0, 1000.0, 1e5}) {
    std::uniform_real_distribution<double> angle(-reach, reach);
    for (int i = 0; i < 20000; ++i) {
      const double x = angle(random);
      ASSERT_LE(units_off(numeric::sin(x), std::sin(x)), 2.0) << x;
      ASSERT_LE(units_off(numeric::cos(x), std::cos(x)), 2.0) << x;
      ASSERT_LE(units_off(numeric::tan(x), std::tan(x)), 4.0) << x;
      ASSERT_LE(units_off(numeric::atan(x), std::atan(x)), 2.0) << x;
      const double sine = x / reach;
      ASSERT_LE(units_off(numeric::asin(sine), std::asin(sine)), 4.0) << sine;
    }
  }
}

// The double next to a multiple of pi is off by its own rounding, which sine must show. Rounding of pi, from
// its digits: pi - double(pi) = 1.2246467991473532e-16.
TEST(Circular, keeps_its_digits_beside_multiples_of_pi) {
  EXPECT_LE(units_off(numeric::sin(pi), 1.2246467991473532e-16), 1.0);
  EXPECT_LE(units_off(numeric::sin(2.0 * pi), -2.4492935982947064e-16), 1.0);
  EXPECT_LE(units_off(numeric::cos(pi / 2.0), 6.123233995736766e-17), 1.0);
  EXPECT_LE(units_off(numeric::cos(1024.5 * pi), std::cos(1024.5 * pi)), 1.0);
}

TEST(Circular, ends_are_exact) {
  EXPECT_EQ(numeric::sin(0.0), 0.0);
  EXPECT_EQ(numeric::cos(0.0), 1.0);
  EXPECT_EQ(numeric::asin(1.0), pi / 2.0);
  EXPECT_EQ(numeric::asin(-1.0), -pi / 2.0);
  EXPECT_EQ(numeric::atan(std::numeric_limits<double>::infinity()), pi / 2.0);
  EXPECT_LE(units_off(numeric::atan(1.0), pi / 4.0), 2.0);
}

TEST(Circular, what_is_no_number_stays_none) {
  const double nothing = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(std::isnan(numeric::atan(nothing)));
  EXPECT_TRUE(std::isnan(numeric::sin(nothing)));
  EXPECT_TRUE(std::isnan(numeric::cos(std::numeric_limits<double>::infinity())));
  EXPECT_TRUE(std::isnan(numeric::asin(1.0 + 1e-15)));
}

}  // namespace
