// Extrapolation against what it must be exact for.
#include "acus/numeric/extrapolation.h"

#include <gtest/gtest.h>

#include <cmath>

namespace acus::numeric {
namespace {

// One node whose three numbers go by polynomials in the step's number, none of more than `degree`.
NodeVector on_the_way(int step, int degree) {
  NodeVector v(node_stride, 0.0);
  for (int c = 0; c < 3; ++c)
    for (int k = 0; k <= degree; ++k) v[c] += (c + 1.0 - k) * std::pow(0.1 * step, k);
  return v;
}

double next_missed_by(const Extrapolation& e, int step, int degree) {
  NodeVector next = on_the_way(step, degree);
  extrapolate(next, e);
  add_scaled_into(next, -1.0, on_the_way(step + 1, degree));
  return std::sqrt(dot(next, next));
}

TEST(Extrapolation, goes_on_exactly_along_lines_parabolas_and_cubics) {
  for (int degree : {1, 2, 3}) {
    Extrapolation e = build_extrapolation(1);
    for (int step = 1; step < 8; ++step) learn(e, on_the_way(step, degree), on_the_way(step - 1, degree));
    EXPECT_LT(next_missed_by(e, 7, degree), 1e-13) << degree;
  }
}

TEST(Extrapolation, of_what_rests_is_rest) {
  NodeVector x(node_stride, 2.0);
  extrapolate(x, build_extrapolation(1));
  EXPECT_EQ(x, NodeVector(node_stride, 2.0));
}

// The higher orders go wrong by more the later they are after a kink; a line is right again at once.
TEST(Extrapolation, takes_a_line_after_a_kink) {
  Extrapolation e = build_extrapolation(1);
  const auto kinked = [](int step) { return NodeVector(node_stride, std::max(0, step - 10)); };
  for (int step = 1; step <= 12; ++step) learn(e, kinked(step), kinked(step - 1));
  EXPECT_EQ(e.order, 1);
  NodeVector next = kinked(12);
  extrapolate(next, e);
  EXPECT_EQ(next, kinked(13));
}

}  // namespace
}  // namespace acus::numeric
