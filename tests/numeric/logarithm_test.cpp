#include "acus/numeric/logarithm.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace acus::numeric {
namespace {

constexpr double unit = std::numeric_limits<double>::epsilon();

TEST(Logarithm, agrees_with_the_library_of_the_machine) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> power(0.0, 30.0);
  for (int i = 0; i < 10000; ++i) {
    const double x = std::exp2(power(random));
    EXPECT_NEAR(log(x), std::log(x), 4.0 * unit * std::max(std::log(x), x - 1.0 < 1.0 ? x - 1.0 : 1.0)) << x;
  }
  EXPECT_EQ(log(1.0), 0.0);
}

}  // namespace
}  // namespace acus::numeric
