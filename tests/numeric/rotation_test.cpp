// The rotation in a deformation gradient, for every kind of gradient that a crushed mesh can produce.
#include <gtest/gtest.h>

#include <random>

#include "acus/numeric/polar.h"
#include "tests/oracles/dense.h"
#include "tests/random_gradient.h"

namespace acus::numeric {
namespace {

// tr(R^T F) of the best rotation: the largest eigenvalue of the quaternion matrix of Horn (1987),
// "Closed-form solution of absolute orientation using unit quaternions", with S = F^T.
double best_trace(const Mat3& F) {
  const Mat3 S = F.transpose();
  Eigen::Matrix4d N;
  N << S(0, 0) + S(1, 1) + S(2, 2), S(1, 2) - S(2, 1), S(2, 0) - S(0, 2), S(0, 1) - S(1, 0),  //
      S(1, 2) - S(2, 1), S(0, 0) - S(1, 1) - S(2, 2), S(0, 1) + S(1, 0), S(2, 0) + S(0, 2),   //
      S(2, 0) - S(0, 2), S(0, 1) + S(1, 0), S(1, 1) - S(0, 0) - S(2, 2), S(1, 2) + S(2, 1),   //
      S(0, 1) - S(1, 0), S(2, 0) + S(0, 2), S(1, 2) + S(2, 1), S(2, 2) - S(0, 0) - S(1, 1);
  return testing::largest_eigenvalue(N);
}

Mat3 random_rotation(std::mt19937& random) {
  std::normal_distribution<double> normal;
  return Eigen::Quaterniond(normal(random), normal(random), normal(random), normal(random))
      .normalized()
      .toRotationMatrix();
}

TEST(Rotation, of_a_million_random_gradients_is_proper_and_the_nearest) {
  std::mt19937 random(1);
  double worst_orthogonality = 0.0, worst_determinant = 0.0, worst_shortfall = 0.0, worst_skew = 0.0;
  for (int i = 0; i < testing::gradient_count; ++i) {
    const Mat3 F = testing::random_gradient(i, random);
    const Mat3 R = rotation_of(F);
    ASSERT_TRUE(R.allFinite()) << "gradient " << i << "\n" << F;
    const double size = F.norm();
    const Mat3 stretch = R.transpose() * F;
    worst_orthogonality = std::max(worst_orthogonality, (R.transpose() * R - Mat3::Identity()).norm());
    worst_determinant = std::max(worst_determinant, std::abs(R.determinant() - 1.0));
    if (size == 0.0) continue;
    worst_shortfall = std::max(worst_shortfall, std::abs(best_trace(F) - stretch.trace()) / size);
    worst_skew = std::max(worst_skew, (stretch - stretch.transpose()).norm() / size);
  }
  EXPECT_LT(worst_orthogonality, 1e-12);
  EXPECT_LT(worst_determinant, 1e-12);
  EXPECT_LT(worst_shortfall, 1e-12);
  EXPECT_LT(worst_skew, 1e-12);
}

TEST(Rotation, beats_every_other_rotation) {
  std::mt19937 random(2);
  for (int i = 0; i < 2000; ++i) {
    const Mat3 F = testing::random_gradient(i, random);
    const double reached = (rotation_of(F).transpose() * F).trace();
    for (int rival = 0; rival < 50; ++rival)
      ASSERT_GE(reached, (random_rotation(random).transpose() * F).trace() - 1e-12 * F.norm()) << F;
  }
}

TEST(Rotation, of_a_turned_stretch_is_that_turn) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> stretch(0.2, 3.0);
  for (int i = 0; i < 2000; ++i) {
    const Mat3 turn = random_rotation(random);
    const Mat3 axes = random_rotation(random);
    const Mat3 U =
        axes * Vec3(stretch(random), stretch(random), stretch(random)).asDiagonal() * axes.transpose();
    ASSERT_LT((rotation_of(turn * U) - turn).norm(), 1e-13);
  }
}

TEST(Rotation, of_an_inverted_gradient_reflects_the_axis_of_least_stretch) {
  std::mt19937 random(4);
  for (int i = 0; i < 2000; ++i) {
    const Mat3 turn = random_rotation(random);
    const Mat3 axes = random_rotation(random);
    const Mat3 U = axes * Vec3(2.0, 1.0, -0.4).asDiagonal() * axes.transpose();
    ASSERT_LT((rotation_of(turn * U) - turn).norm(), 1e-12);
  }
}

TEST(Rotation, of_a_mirror_and_of_nothing_is_proper) {
  EXPECT_NEAR(rotation_of(-Mat3::Identity()).determinant(), 1.0, 1e-15);
  EXPECT_EQ(rotation_of(Mat3::Zero()), Mat3(Mat3::Identity()));
}

}  // namespace
}  // namespace acus::numeric
