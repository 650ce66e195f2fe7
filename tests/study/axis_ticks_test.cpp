#include "acus/study/axis_ticks.h"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>

namespace acus::study {
namespace {

struct Known {
  double low, high;
  int wanted;
  std::vector<double> at;
};

// The published cases of d3-array's ticks(), a widely used program for the same purpose.
TEST(AxisTicks, ticks_stand_where_d3_puts_them) {
  const Known cases[] = {
      {0, 1, 10, {0, .1, .2, .3, .4, .5, .6, .7, .8, .9, 1}},
      {0, 1, 5, {0, .2, .4, .6, .8, 1}},
      {0, 1, 3, {0, .5, 1}},
      {0, 10, 8, {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10}},
      {0, 10, 6, {0, 2, 4, 6, 8, 10}},
      {0, 10, 3, {0, 5, 10}},
      {-10, 10, 10, {-10, -8, -6, -4, -2, 0, 2, 4, 6, 8, 10}},
      {-10, 10, 5, {-10, -5, 0, 5, 10}},
      {-10, 10, 2, {-10, 0, 10}},
  };
  for (const Known& known : cases) {
    const Ticks ticks = axis_ticks(known.low, known.high, known.wanted);
    ASSERT_EQ(ticks.at.size(), known.at.size())
        << known.low << " to " << known.high << " by " << known.wanted;
    for (std::size_t i = 0; i < ticks.at.size(); ++i) EXPECT_NEAR(ticks.at[i], known.at[i], 1e-12);
  }
}

// From 2^53 on the next number is 2 further; an axis of a few such steps has no round numbers between them.
TEST(AxisTicks, limits_apart_by_rounding_only_have_one_tick) {
  const double large = 9007199254740992.0;
  for (const auto& [low, high] : {std::pair{large, large + 4.0},
                                  {0.3, std::nextafter(0.3, 1.0)},
                                  {2.0, 2.0},
                                  {0.0, 0.0},
                                  {0.0, 5e-324},
                                  {-1.7e308, 1.7e308}})
    EXPECT_EQ(axis_ticks(low, high, 5).at, std::vector<double>{low});
}

TEST(AxisTicks, labels_tell_neighbours_apart) {
  EXPECT_EQ(tick_label(0.30000000000000004, 0.1), "0.3");
  EXPECT_EQ(tick_label(20.0, 10.0), "20");
  EXPECT_EQ(tick_label(0.05, 0.05), "0.05");
  EXPECT_EQ(tick_label(-0.0, 0.5), "0.0");
  EXPECT_EQ(tick_label(-1e-17, 0.5), "0.0");
}

TEST(AxisTicks, short_numbers_keep_their_significant_digits) {
  EXPECT_EQ(short_number(0.64159, 3), "0.642");
  EXPECT_EQ(short_number(1.0, 3), "1");
  EXPECT_EQ(short_number(1500.0, 3), "1500");
  EXPECT_EQ(short_number(0.000123456, 3), "0.000123");
  EXPECT_EQ(short_number(0.0, 3), "0");
  EXPECT_EQ(short_number(-0.5, 2), "-0.5");
}

}  // namespace
}  // namespace acus::study
