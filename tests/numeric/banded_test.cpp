#include "acus/numeric/banded.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <random>

namespace {

using acus::numeric::BandedMatrix;
using acus::numeric::Lane4;

// A random symmetric matrix of this band whose rows have at least `surplus` more on the diagonal than beside
// it.
template <int band>
Eigen::MatrixXd random_banded(int size, double surplus, std::mt19937_64& random) {
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(size, size);
  for (int i = 0; i < size; ++i)
    for (int j = std::max(0, i - band); j < i; ++j) a(i, j) = a(j, i) = any(random);
  for (int i = 0; i < size; ++i) a(i, i) = a.row(i).cwiseAbs().sum() + surplus;
  return a;
}

template <int band>
BandedMatrix<band> banded(const Eigen::MatrixXd& dense) {
  const int size = static_cast<int>(dense.rows());
  BandedMatrix<band> m(size);
  for (int i = 0; i < size; ++i)
    for (int j = std::max(0, i - band); j <= i; ++j) m.add(i, j, dense(i, j));
  return m;
}

template <int band>
void expect_solves_like_eigen() {
  std::mt19937_64 random(7);
  for (const int size : {1, 2, 3, band, band + 1, band + 2, 2 * band + 1, 60}) {
    const Eigen::MatrixXd a = random_banded<band>(size, 1e-2, random);
    const Eigen::VectorXd b = Eigen::VectorXd::Random(size);
    BandedMatrix<band> m = banded<band>(a);
    ASSERT_TRUE(m.factor()) << size;
    Eigen::VectorXd x = b;
    m.solve(x.data());
    EXPECT_LT((x - a.ldlt().solve(b)).norm(), 1e-11 * x.norm()) << "size " << size << " band " << band;
  }
}

TEST(BandedMatrix, solves_like_eigen) {
  expect_solves_like_eigen<2>();
  expect_solves_like_eigen<3>();
  expect_solves_like_eigen<10>();
  expect_solves_like_eigen<11>();
}

TEST(BandedMatrix, solves_for_many_sides_at_once_with_the_same_bits) {
  std::mt19937_64 random(3);
  constexpr int size = 47;
  BandedMatrix<10> m = banded<10>(random_banded<10>(size, 1.0, random));
  ASSERT_TRUE(m.factor());
  std::vector<Lane4> many(size);
  for (int i = 0; i < size; ++i) many[i] = Lane4{1.0, 0.1 * i, i % 3 - 1.0, 1.0 / (i + 1)};
  const std::vector<Lane4> sides = many;
  m.solve(many.data());
  for (int side = 0; side < 4; ++side) {
    std::vector<double> one(size);
    for (int i = 0; i < size; ++i) one[i] = sides[i][side];
    m.solve(one.data());
    for (int i = 0; i < size; ++i) EXPECT_EQ(one[i], many[i][side]);
  }
}

TEST(BandedMatrix, refuses_what_is_not_definite) {
  std::mt19937_64 random(11);
  constexpr int size = 30;
  for (int trial = 0; trial < 50; ++trial) {
    Eigen::MatrixXd a = random_banded<10>(size, 0.0, random);
    a.diagonal() *= 0.02 * (trial + 1);
    const double least = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(a).eigenvalues()[0];
    EXPECT_EQ(banded<10>(a).factor(), least > 0.0) << least;
  }
  Eigen::MatrixXd a = Eigen::MatrixXd::Identity(size, size);
  a(size - 1, size - 1) = std::nan("");
  EXPECT_FALSE(banded<10>(a).factor());
}

}  // namespace
