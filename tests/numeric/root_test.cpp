#include "acus/numeric/root.h"

#include <gtest/gtest.h>

#include <cmath>

namespace {

using acus::numeric::bracketed_root;

TEST(BracketedRoot, finds_textbook_roots_to_the_last_bits) {
  EXPECT_NEAR(bracketed_root([](double x) { return std::cos(x) - x; }, 0.0, 1.0), 0.7390851332151607, 2e-16);
  // Wallis's own example for Newton's method: x^3 - 2x - 5.
  EXPECT_NEAR(bracketed_root([](double x) { return x * x * x - 2.0 * x - 5.0; }, 2.0, 3.0),
              2.0945514815423265, 5e-16);
}

TEST(BracketedRoot, finds_roots_where_secants_crawl) {
  EXPECT_NEAR(bracketed_root([](double x) { return std::pow(x, 9); }, -1.0, 1.5, 1e-9), 0.0, 1e-9);
  EXPECT_NEAR(bracketed_root([](double x) { return std::log(x) + 30.0; }, 1e-200, 1.0) / std::exp(-30.0), 1.0,
              1e-12);
  EXPECT_NEAR(bracketed_root([](double x) { return std::exp(60.0 * x) - 2.0; }, -10.0, 10.0),
              std::log(2.0) / 60.0, 1e-16);
}

TEST(BracketedRoot, takes_a_bracket_in_either_order_or_with_a_root_at_its_end) {
  const auto f = [](double x) { return x * x - 4.0; };
  EXPECT_DOUBLE_EQ(bracketed_root(f, 5.0, 0.0), 2.0);
  EXPECT_DOUBLE_EQ(bracketed_root(f, 2.0, 5.0), 2.0);
  EXPECT_DOUBLE_EQ(bracketed_root(f, 0.0, 2.0), 2.0);
}

TEST(BracketedRoot, closes_on_a_jump_and_always_ends) {
  int evaluations = 0;
  const double jump = bracketed_root(
      [&](double x) {
        ++evaluations;
        return x < 0.3 ? -1.0 : 1.0;
      },
      0.0, 1.0);
  EXPECT_NEAR(jump, 0.3, 1e-15);
  EXPECT_LT(evaluations, 202);
}

}  // namespace
