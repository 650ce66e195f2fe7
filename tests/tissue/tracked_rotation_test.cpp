// One correction of a tracked rotation, on one element alone.
#include "acus/tissue/tracked_rotation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "acus/base/vec.h"

namespace acus::tissue {
namespace {

Mat3 turn(const Vec3& w) { return Eigen::AngleAxisd(w.norm(), w.normalized()).toRotationMatrix(); }

double angle_between(const Mat3& a, const Mat3& b) {
  const Mat3 skew = a.transpose() * b - b.transpose() * a;
  return 0.5 * Vec3(skew(2, 1), skew(0, 2), skew(1, 0)).norm();
}

struct Corrected {
  Eigen::Quaterniond turn;
  double change = 0.0, margin = 0.0;
  Mat3 rotation() const { return turn.normalized().toRotationMatrix(); }
};
Corrected correct(const Mat3& F, const Eigen::Quaterniond& turn) {
  Corrected c{turn};
  const Mat3 h = F - Mat3::Identity();
  Mat3 r, b;
  turn_less_identity(r.data(), turn.coeffs().data());
  stretch_less_identity(b.data(), r.data(), h.data());
  c.margin = correct_turn(c.turn.coeffs().data(), b.data(), c.change);
  return c;
}
Corrected correct(const Mat3& F, const Mat3& R) { return correct(F, Eigen::Quaterniond(R)); }

// Stretches between 0.7 and 1.4 along random axes.
Mat3 random_stretch(std::mt19937& random) {
  std::uniform_real_distribution<double> any(-1.0, 1.0), stretch(0.7, 1.4);
  const Mat3 axes = turn(3.0 * Vec3(any(random), any(random), any(random)));
  return axes * Vec3(stretch(random), stretch(random), stretch(random)).asDiagonal() * axes.transpose();
}

TEST(TrackedRotation, one_correction_leaves_the_cube_of_the_turn) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  for (int trial = 0; trial < 200; ++trial) {
    const Mat3 R = turn(Vec3(any(random), any(random), any(random)));
    const Mat3 F = R * random_stretch(random);  // whose polar rotation is R by construction
    const Vec3 way = Vec3(any(random), any(random), any(random)).normalized();
    for (const double w : {0.1, 0.01, 1e-3, 1e-4}) {
      const Corrected c = correct(F, turn(w * way) * R);
      EXPECT_NEAR(std::sqrt(c.change), w, 0.2 * w);
      EXPECT_GT(c.margin, 0.0);
      EXPECT_LT(angle_between(c.rotation(), R), 0.5 * w * w * w + 1e-15);
      EXPECT_NEAR(c.turn.norm(), 1.0, 0.1 * w * w * w * w + 1e-15);
    }
  }
}

TEST(TrackedRotation, does_not_take_a_saddle_for_the_nearest_rotation) {
  // Half a turn away B is symmetric, too: stretches of two axes are negative.
  std::mt19937 random(6);
  for (int trial = 0; trial < 50; ++trial) {
    const Mat3 F = random_stretch(random);
    const Eigen::SelfAdjointEigenSolver<Mat3> axes(F);
    const Corrected c = correct(F, turn(M_PI * axes.eigenvectors().col(trial % 3)));
    EXPECT_LT(c.change, 1e-20);  // nothing to correct ...
    EXPECT_LT(c.margin, 0.0);    // ... and yet not the nearest
  }
}

// Turning for long: the quaternion keeps its length.
TEST(TrackedRotation, stays_a_rotation_over_a_million_corrections) {
  const Mat3 F = Vec3(1.1, 0.9, 1.05).asDiagonal();
  Corrected tracked{Eigen::Quaterniond::Identity()};
  Mat3 turned = Mat3::Identity();
  const Mat3 step = turn(Vec3(2e-3, -1e-3, 3e-3));
  for (int i = 0; i < 1000000; ++i) {
    turned = step * turned;
    if (i % 1000 == 0) turned = Eigen::Quaterniond(turned).normalized().toRotationMatrix();
    tracked = correct(turned * F, tracked.turn);
  }
  EXPECT_NEAR(tracked.turn.norm(), 1.0, 1e-11);
  const Mat3 R = tracked.rotation();
  EXPECT_LT(angle_between(R, turned), 1e-7);
}

}  // namespace
}  // namespace acus::tissue
