#include "acus/base/decimal.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <limits>
#include <random>

namespace acus {
namespace {

TEST(Decimal, text_is_short_for_the_numbers_people_write) {
  EXPECT_EQ(decimal_text(0.1), "0.1");
  EXPECT_EQ(decimal_text(0.0003), "0.0003");
  EXPECT_EQ(decimal_text(25000.0), "25000");
  EXPECT_EQ(decimal_text(1.0 / 3.0), "0.3333333333333333");
}

TEST(Decimal, text_reads_back_as_the_same_double_whatever_its_bits) {
  std::mt19937_64 bits(7);
  for (int i = 0; i < 100000; ++i) {
    double value;
    const auto word = bits();
    static_assert(sizeof word == sizeof value);
    std::memcpy(&value, &word, sizeof value);
    if (std::isfinite(value)) {
      ASSERT_EQ(std::strtod(decimal_text(value).c_str(), nullptr), value);
    }
  }
}

TEST(Decimal, shifting_the_point_gives_the_double_of_the_written_literal) {
  EXPECT_EQ(times_power_of_ten(0.3, -3), 0.3e-3);
  EXPECT_EQ(times_power_of_ten(0.05, -3), 0.05e-3);
  EXPECT_EQ(times_power_of_ten(2.5e-7, 9), 2.5e2);
  EXPECT_EQ(times_power_of_ten(-0.0, 3), 0.0);
  EXPECT_EQ(times_power_of_ten(1e308, 9), std::numeric_limits<double>::infinity());
}

}  // namespace
}  // namespace acus
