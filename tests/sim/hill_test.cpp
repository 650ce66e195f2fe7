#include "acus/sim/hill.h"

#include <gtest/gtest.h>

namespace acus {
namespace {

constexpr double v0 = 20e-3, limit = 3.0;  // m/s, N

// As Hill wrote it: (P + a)(v + b) = (P0 + a) b, with a / P0 = b / v0 = 1/4.
TEST(Hill, speed_lies_on_his_hyperbola) {
  const double a = limit / 4.0, b = v0 / 4.0;
  for (double load : {0.0, 0.3, 1.0, 2.5, 3.0}) {
    const double v = hill_speed(load, v0, limit);
    EXPECT_NEAR((load + a) * (v + b), (limit + a) * b, 1e-15) << load;
  }
  EXPECT_EQ(hill_speed(0.0, v0, limit), v0);
  EXPECT_EQ(hill_speed(limit, v0, limit), 0.0);
  EXPECT_NEAR(hill_speed(hill_half_speed_load(limit), v0, limit), 0.5 * v0, 1e-15);
}

TEST(Hill, load_that_pulls_the_hand_on_makes_it_no_faster) { EXPECT_EQ(hill_speed(-1.0, v0, limit), v0); }

// Katz: about six times as much force for each speed when stretched as when shortening.
TEST(Hill, hand_gives_way_beyond_the_limit_six_times_as_stiffly) {
  const double d = 1e-6;  // N
  const double shortening = (hill_speed(limit - d, v0, limit) - hill_speed(limit, v0, limit)) / d;
  const double stretched = (hill_speed(limit, v0, limit) - hill_speed(limit + d, v0, limit)) / d;
  EXPECT_NEAR(shortening / stretched, 6.0, 1e-5);
  EXPECT_LT(hill_speed(2.0 * limit, v0, limit), 0.0);
}

TEST(Hill, speed_falls_most_where_the_load_begins) {
  const double d = 1e-6, steepest = hill_steepest_fall(v0, limit);
  EXPECT_NEAR((hill_speed(0.0, v0, limit) - hill_speed(d, v0, limit)) / d, steepest, 1e-4 * steepest);
  for (double load = 0.1; load < 6.0; load += 0.1)
    EXPECT_LT(hill_speed(load - 0.1, v0, limit) - hill_speed(load, v0, limit), 0.1 * steepest) << load;
}

}  // namespace
}  // namespace acus
