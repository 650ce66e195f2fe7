#include "acus/study/curve.h"

#include <gtest/gtest.h>

#include <cmath>

namespace acus::study {
namespace {

double distance_to_polyline(const Point2& p, const std::vector<Point2>& line) {
  double least = HUGE_VAL;
  for (std::size_t i = 1; i < line.size(); ++i) {
    constexpr int samples = 100;
    for (int k = 0; k <= samples; ++k) {
      const double s = static_cast<double>(k) / samples;
      least = std::min(least, std::hypot(line[i - 1][0] + s * (line[i][0] - line[i - 1][0]) - p[0],
                                         line[i - 1][1] + s * (line[i][1] - line[i - 1][1]) - p[1]));
    }
  }
  return least;
}

TEST(Curve, a_simplified_curve_stays_within_its_tolerance) {
  std::vector<Point2> wave;
  for (int i = 0; i <= 2000; ++i) wave.push_back({0.1 * i, 20.0 * std::sin(0.01 * i) * std::cos(0.03 * i)});
  const std::vector<Point2> fewer = simplified(wave, 0.25);
  EXPECT_LT(fewer.size(), wave.size() / 10);
  for (const Point2& p : wave) EXPECT_LT(distance_to_polyline(p, fewer), 0.27);
  EXPECT_EQ(fewer.front(), wave.front());
  EXPECT_EQ(fewer.back(), wave.back());
}

TEST(Curve, a_spike_of_one_sample_survives) {
  std::vector<Point2> flat;
  for (int i = 0; i < 100; ++i) flat.push_back({1.0 * i, i == 50 ? 10.0 : 0.0});
  const std::vector<Point2> fewer = simplified(flat, 0.25);
  ASSERT_EQ(fewer.size(), 5u);  // both ends, the spike and its feet
  EXPECT_EQ(fewer[2], (Point2{50.0, 10.0}));
}

TEST(Curve, values_between_samples_lie_on_straight_lines) {
  const std::vector<double> xs{0.0, 1.0, 1.0, 3.0}, ys{0.0, 2.0, 4.0, 8.0};
  EXPECT_DOUBLE_EQ(value_at(xs, ys, 0.25), 0.5);
  EXPECT_DOUBLE_EQ(value_at(xs, ys, 2.0), 6.0);
  EXPECT_DOUBLE_EQ(value_at(xs, ys, -1.0), 0.0);
  EXPECT_DOUBLE_EQ(value_at(xs, ys, 9.0), 8.0);
}

TEST(Curve, the_circle_through_a_short_arc_has_its_curvature) {
  std::vector<Point2> arc, line;
  for (int i = 0; i <= 50; ++i) {
    const double angle = 0.003 * i;
    arc.push_back({3.0 + 400.0 * std::sin(angle), 1.0 + 400.0 * (1.0 - std::cos(angle))});
    line.push_back({1.0 * i, 0.5 * i});
  }
  const auto circle = circle_through(arc);
  ASSERT_TRUE(circle);
  EXPECT_NEAR(circle->curvature, 1.0 / 400.0, 1e-8);
  EXPECT_LT(circle->residual, 1e-6);
  arc[25][1] += 0.3;
  EXPECT_NEAR(circle_through(arc)->residual, 0.3 / std::sqrt(51.0), 0.01);
  EXPECT_FALSE(circle_through(line));
  EXPECT_FALSE(circle_through(std::span(arc).first(2)));
}

}  // namespace
}  // namespace acus::study
