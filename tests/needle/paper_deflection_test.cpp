#include "acus/needle/paper_deflection.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "acus/needle/elastica.h"

namespace {

using namespace acus::needle;
using std::numbers::pi;
constexpr double degree = pi / 180.0;

TEST(PaperDeflection, end_slope_solves_eq_12) {
  for (double alpha_deg : {0.5, 5.0, 20.0, 60.0, 90.0, 120.0, 150.0, 175.0, 179.9}) {
    const double alpha = alpha_deg * degree;
    const double first = std::comp_ellint_1(std::sin(alpha / 2.0));
    const double load = std::pow(2.0 * first / pi, 2);
    EXPECT_NEAR(end_slope(0.3 * load, 0.3), alpha, 1e-9) << alpha_deg;
  }
}

// Timoshenko and Gere, Theory of Elastic Stability, Table 2-5 (P / Pcr by end slope).
TEST(PaperDeflection, end_slope_matches_the_published_table) {
  struct Row {
    double degrees, load;
  };
  for (const Row& row : {Row{20, 1.015}, Row{40, 1.063}, Row{60, 1.152}, Row{80, 1.293}, Row{100, 1.518},
                         Row{120, 1.884}, Row{140, 2.541}, Row{160, 4.029}, Row{176, 9.116}}) {
    EXPECT_NEAR(end_slope(row.load, 1.0) / degree, row.degrees, 0.4) << row.degrees;
  }
}

TEST(PaperDeflection, needle_is_straight_below_the_critical_load_and_never_turns_past_180_degrees) {
  EXPECT_EQ(end_slope(0.0, 0.5), 0.0);
  EXPECT_EQ(end_slope(0.5, 0.5), 0.0);
  EXPECT_GT(end_slope(0.5 * (1.0 + 1e-12), 0.5), 0.0);
  double last = 0.0;
  for (double load = 0.51; load < 1e9; load *= 1.7) {
    const double alpha = end_slope(load, 0.5);
    EXPECT_GE(alpha, last);
    EXPECT_LE(alpha, pi);
    last = alpha;
  }
  EXPECT_NEAR(last, pi, 1e-12);
}

// The exact bow of the elastica of end slope alpha is L k / K, its span L (2E/K - 1), k = sin(alpha/2).
TEST(PaperDeflection, amplitude_of_eq_11_exceeds_the_elastica_by_the_stated_percentages) {
  struct Row {
    double degrees, excess, tolerance;
  };
  for (const Row& row :
       {Row{20, 0.024, 5e-4}, Row{40, 0.115, 5e-4}, Row{60, 0.38, 5e-3}, Row{80, 1.81, 5e-3}}) {
    const double k = std::sin(row.degrees * degree / 2.0);
    const double span = 2.0 * std::comp_ellint_2(k) / std::comp_ellint_1(k) - 1.0;
    const double exact = k / std::comp_ellint_1(k);
    EXPECT_NEAR(paper_amplitude(span, row.degrees * degree) / exact - 1.0, row.excess, row.tolerance);
    const Elastica beside = elastica(Support::pinned_pinned, 1.0 - span);
    EXPECT_NEAR(beside.bow_ratio, exact, 1e-12);
    EXPECT_NEAR(beside.tip_slope, row.degrees * degree, 1e-12);
  }
}

TEST(PaperDeflection, sine_of_eq_11_is_1_14_needles_long_at_60_degrees) {
  const double k = std::sin(30.0 * degree);
  const double span = 2.0 * std::comp_ellint_2(k) / std::comp_ellint_1(k) - 1.0;
  constexpr int pieces = 20000;
  double length = 0.0;
  for (int i = 0; i < pieces; ++i) {
    const double x0 = span * i / pieces;
    const double x1 = span * (i + 1) / pieces;
    length +=
        std::hypot(x1 - x0, paper_shape(x1, span, 60.0 * degree) - paper_shape(x0, span, 60.0 * degree));
  }
  EXPECT_NEAR(length, 1.14, 5e-3);
}

TEST(PaperDeflection, shape_is_a_sine_between_the_ends) {
  EXPECT_NEAR(paper_shape(0.05, 0.1, 0.3), 0.1 / pi * std::tan(0.3), 1e-17);
  EXPECT_EQ(paper_shape(0.0, 0.1, 0.3), 0.0);
  EXPECT_NEAR(paper_shape(0.1, 0.1, 0.3), 0.0, 1e-17);
}

}  // namespace
