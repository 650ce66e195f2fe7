#include "acus/sim/tremor.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

namespace acus {
namespace {

constexpr double rms = 50e-6, step = 1e-3, after = 1.0;  // m, s, s
constexpr int window = 2500;                             // steps: 0.4 Hz from one line to the next

std::vector<double> grown_tremor(int seed) {
  std::vector<double> x;
  for (int i = 0; i < window; ++i) x.push_back(tremor(rms, seed, after + i * step));
  return x;
}

// Mean square at the lines of a discrete Fourier transform from `low` to `high` [Hz].
double power(const std::vector<double>& x, double low, double high) {
  const double turn = 2.0 * std::numbers::pi / static_cast<double>(x.size()), line = 1.0 / (window * step);
  double sum = 0.0;
  for (int k = static_cast<int>(std::ceil(low / line)); k <= static_cast<int>(high / line); ++k) {
    std::complex<double> coefficient = 0.0;
    for (std::size_t i = 0; i < x.size(); ++i)
      coefficient += x[i] * std::polar(1.0, -turn * k * static_cast<double>(i));
    sum += (k == 0 ? 1.0 : 2.0) * std::norm(coefficient / static_cast<double>(x.size()));
  }
  return sum;
}

TEST(Tremor, has_the_asked_rms_all_of_it_between_8_and_12_Hz) {
  for (int seed : {0, 1, 2, 77}) {
    const std::vector<double> x = grown_tremor(seed);
    EXPECT_NEAR(std::sqrt(power(x, 8.0, 12.0)) / rms, 1.0, 1e-9) << seed;
    EXPECT_LT(power(x, 0.0, 7.9) + power(x, 12.1, 100.0), 1e-12 * rms * rms) << seed;
  }
}

TEST(Tremor, is_the_same_for_a_seed_and_another_for_another) {
  EXPECT_EQ(grown_tremor(3), grown_tremor(3));
  const std::vector<double> one = grown_tremor(3), other = grown_tremor(4);
  double product = 0.0;
  for (int i = 0; i < window; ++i)
    product += one[static_cast<std::size_t>(i)] * other[static_cast<std::size_t>(i)];
  EXPECT_LT(std::abs(product / window), 0.9 * rms * rms);  // not the same motion
}

TEST(Tremor, begins_at_rest_and_stays_within_its_bounds) {
  EXPECT_EQ(tremor(rms, 1, 0.0), 0.0);
  for (int seed = 0; seed < 50; ++seed)
    for (double t = 0.0; t < 3.0; t += step) {
      const double here = tremor(rms, seed, t);
      ASSERT_LE(std::abs(here), furthest_tremor(rms));
      ASSERT_LE(std::abs(tremor(rms, seed, t + step) - here), step * fastest_tremor(rms));
    }
  EXPECT_EQ(tremor(0.0, 1, 1.0), 0.0);
}

}  // namespace
}  // namespace acus
