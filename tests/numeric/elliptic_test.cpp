#include "acus/numeric/elliptic.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <random>

namespace {

using namespace acus::numeric;
using std::numbers::pi;

// Abramowitz and Stegun, Table 17.1: K and E by the parameter m = k^2.
TEST(Elliptic, complete_integrals_match_the_published_table) {
  struct Row {
    double m, first, second;
  };
  constexpr std::array table = {
      Row{0.0, 1.570796326794897, 1.570796326794897}, Row{0.1, 1.612441348720219, 1.530757636897763},
      Row{0.5, 1.854074677301372, 1.350643881047675}, Row{0.9, 2.578092113348173, 1.104774732704073}};
  for (const Row& row : table) {
    const auto [first, second] = complete_elliptic(std::sqrt(row.m));
    EXPECT_NEAR(first, row.first, 2e-15 * row.first) << row.m;
    EXPECT_NEAR(second, row.second, 2e-15 * row.second) << row.m;
  }
}

// libstdc++ itself is good to some 1e-12 near k = 1.
TEST(Elliptic, complete_integrals_match_the_standard_library_up_to_the_last_modulus) {
  for (double k : {1e-9, 1e-3, 0.3, 0.7, 0.9, 0.99, 0.999999, 1.0 - 1e-12, std::nextafter(1.0, 0.0)}) {
    const auto [first, second] = complete_elliptic(k);
    EXPECT_NEAR(first, std::comp_ellint_1(k), 1e-11 * first) << k;
    EXPECT_NEAR(second, std::comp_ellint_2(k), 1e-11) << k;
  }
}

// From a computation with fifty digits.
TEST(Elliptic, complete_integrals_keep_their_digits_near_the_last_modulus) {
  struct Row {
    double k, first, second;
  };
  constexpr std::array table = {Row{0.99, 3.3566005233611919424804, 1.0284758090288040218707},
                                Row{0.999999, 7.9474797735479670326662, 1.0000074474777243921495},
                                Row{1.0 - 1e-12, 14.855242389793774712267, 1.0000000000143549248271}};
  for (const Row& row : table) {
    const auto [first, second] = complete_elliptic(row.k);
    EXPECT_NEAR(first, row.first, 1e-15 * row.first) << row.k;
    EXPECT_NEAR(second, row.second, 4e-15) << row.k;
  }
}

// Legendre's relation ties K and E of a modulus to those of its complement: E K' + E' K - K K' = pi/2.
TEST(Elliptic, complete_integrals_obey_legendres_relation) {
  for (double k : {0.05, 0.2, 0.5, 0.8, 0.95}) {
    const auto [first, second] = complete_elliptic(k);
    const auto [cofirst, cosecond] = complete_elliptic(std::sqrt(1.0 - k * k));
    EXPECT_NEAR(second * cofirst + cosecond * first - first * cofirst, pi / 2.0, 4e-15) << k;
  }
}

TEST(Elliptic, incomplete_integrals_match_the_standard_library_in_every_quadrant) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> any_phi(-10.0, 10.0);
  std::uniform_real_distribution<double> any_modulus(0.0, 0.999);
  for (int i = 0; i < 2000; ++i) {
    const double phi = any_phi(random);
    const double k = any_modulus(random);
    const auto [first, second] = incomplete_elliptic(phi, k);
    EXPECT_NEAR(first, std::ellint_1(k, phi), 1e-11) << phi << ' ' << k;
    EXPECT_NEAR(second, std::ellint_2(k, phi), 1e-11) << phi << ' ' << k;
  }
}

TEST(Elliptic, incomplete_integrals_at_a_quarter_turn_are_the_complete_ones) {
  for (double k : {0.0, 0.4, 0.9}) {
    const auto complete = complete_elliptic(k);
    const auto incomplete = incomplete_elliptic(pi / 2.0, k);
    EXPECT_NEAR(incomplete.first, complete.first, 1e-15 * complete.first) << k;
    EXPECT_NEAR(incomplete.second, complete.second, 1e-15 * complete.second) << k;
  }
}

// For k = 1 both integrals are elementary, E(phi, 1) = sin(phi) and F(phi, 1) = artanh(sin phi); for k = 0
// both are phi.
TEST(Elliptic, incomplete_integrals_reach_their_elementary_limits) {
  const double almost_one = 1.0 - 1e-15;
  for (double phi : {0.1, 0.5, 1.0}) {
    EXPECT_NEAR(incomplete_elliptic(phi, almost_one).first, std::atanh(std::sin(phi)), 4e-15);
    EXPECT_NEAR(incomplete_elliptic(phi, almost_one).second, std::sin(phi), 4e-15);
    EXPECT_EQ(incomplete_elliptic(phi, 0.0).first, phi);
    EXPECT_EQ(incomplete_elliptic(phi, 0.0).second, phi);
  }
}

TEST(Elliptic, amplitude_inverts_the_integral_of_the_first_kind) {
  std::mt19937_64 random(8);
  std::uniform_real_distribution<double> any_phi(-10.0, 10.0);
  std::uniform_real_distribution<double> any_modulus(0.0, 0.99);
  for (int i = 0; i < 2000; ++i) {
    const double phi = any_phi(random);
    const double k = any_modulus(random);
    EXPECT_NEAR(jacobi_amplitude(std::ellint_1(k, phi), k), phi, 1e-12) << phi << ' ' << k;
  }
}

// Gauss's constant 1 / agm(1, sqrt 2) = 0.8346268416740731 (OEIS A014549).
TEST(Elliptic, mean_of_one_and_root_two_is_the_inverse_of_gauss_constant) {
  EXPECT_NEAR(1.0 / arithmetic_geometric_mean(1.0, std::sqrt(2.0)), 0.8346268416740731863, 1e-15);
}

}  // namespace
