#include "acus/numeric/elementary.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace acus::numeric {
namespace {

constexpr double unit = std::numeric_limits<double>::epsilon();

TEST(Elementary, agrees_with_the_library_of_the_machine) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> power(0.0, 30.0);
  for (int i = 0; i < 10000; ++i) {
    const double x = std::exp2(power(random)), y = std::exp2(power(random) - 15.0) * 1e-6;
    EXPECT_NEAR(log(x), std::log(x), 4.0 * unit * std::max(std::log(x), x - 1.0 < 1.0 ? x - 1.0 : 1.0)) << x;
    EXPECT_NEAR(cube_root(y), std::cbrt(y), 2.0 * unit * std::cbrt(y)) << y;
  }
  EXPECT_EQ(log(1.0), 0.0);
  EXPECT_EQ(cube_root(27.0), 3.0);
}

}  // namespace
}  // namespace acus::numeric
