// The coarse correction against what it must be: interpolation of smooth fields, exact solution on the grid.
#include "acus/numeric/coarse_space.h"

#include <gtest/gtest.h>

#include <functional>
#include <random>

namespace acus::numeric {
namespace {

// 1000 points in a box; A = 2 I plus a random chain of springs between successive points.
class CoarseSpaces : public ::testing::Test {
 protected:
  CoarseSpaces() {
    std::mt19937 random(11);
    std::uniform_real_distribution<double> uniform(0.0, 1.0);
    for (int i = 0; i < 1000; ++i)
      points_.emplace_back(uniform(random), uniform(random), 0.5 * uniform(random));
    for (int i = 0; i < 999; ++i) spring_.push_back(uniform(random));
    space_ = build_coarse_space(points_, matrix());
    scratch_ = build_scratch(space_);
  }
  LowerBlocks matrix() const {
    LowerBlocks a;
    for (int i = 0; i < 1000; ++i) {
      const double before = i > 0 ? spring_[i - 1] : 0.0, after = i < 999 ? spring_[i] : 0.0;
      auto& row = a.rows.emplace_back();
      if (i > 0) row.push_back({.column = i - 1, .block = -before * Mat3::Identity()});
      row.push_back({.column = i, .block = (2.0 + before + after) * Mat3::Identity()});
    }
    return a;
  }
  NodeVector field(const std::function<Vec3(const Vec3&)>& f) const {
    NodeVector v(node_stride * points_.size(), 0.0);
    for (std::size_t i = 0; i < points_.size(); ++i) at(v, static_cast<int>(i)) = f(points_[i]);
    return v;
  }
  NodeVector random_field(unsigned seed) const {
    std::mt19937 random(seed);
    std::normal_distribution<double> normal;
    return field([&](const Vec3&) { return Vec3(normal(random), normal(random), normal(random)); });
  }
  NodeVector image_of(const NodeVector& x) const {
    NodeVector y = x;
    for (double& number : y) number *= 2.0;
    for (int i = 0; i < 999; ++i) {
      const Vec3 force = spring_[i] * (at(x, i) - at(x, i + 1));
      at(y, i) += force;
      at(y, i + 1) -= force;
    }
    return y;
  }
  NodeVector corrected(const NodeVector& r) {
    NodeVectorOf<float> z(r.size(), 0.0F);
    add_coarse_correction_into(z, space_, NodeVectorOf<float>(r.begin(), r.end()), scratch_);
    return NodeVector(z.begin(), z.end());
  }

  std::vector<Vec3> points_;
  std::vector<double> spring_;
  CoarseSpace space_;
  CoarseScratch scratch_;
};

TEST_F(CoarseSpaces, weights_are_a_partition_of_unity) {
  for (const auto& w : space_.weight) {
    EXPECT_NEAR(w[0] + w[1] + w[2] + w[3], 1.0F, 1e-6F);
    for (float one : w) EXPECT_GE(one, -1e-6F);
  }
}

// A linear field lies in the grid's space, so A's image of it is answered by the field itself, up to single
// precision and the regularisation of 1e-4.
TEST_F(CoarseSpaces, linear_fields_are_recovered_from_their_images) {
  const NodeVector linear =
      field([](const Vec3& x) { return Vec3(1.0 + x.y(), x.z() - 2.0 * x.x(), 3.0 * x.z()); });
  NodeVector z = corrected(image_of(linear));
  const double norm = std::sqrt(dot(linear, linear));
  add_scaled_into(z, -1.0, linear);
  EXPECT_LT(std::sqrt(dot(z, z)), 1e-3 * norm);
}

TEST_F(CoarseSpaces, correction_is_symmetric_and_never_negative) {
  for (unsigned seed = 1; seed < 6; ++seed) {
    const NodeVector a = random_field(seed), b = random_field(seed + 100);
    const NodeVector za = corrected(a), zb = corrected(b);
    EXPECT_NEAR(dot(za, b), dot(zb, a), 1e-5 * std::sqrt(dot(za, a) * dot(zb, b)));
    EXPECT_GE(dot(za, a), 0.0);
    EXPECT_GE(dot(zb, b), 0.0);
  }
}

TEST(CoarseSpace, stands_points_in_one_plane_and_repeated_points) {
  std::vector<Vec3> points(40, Vec3(1.0, 2.0, 3.0));
  for (int i = 0; i < 20; ++i) points[i].x() = 0.1 * i;
  LowerBlocks identity;
  for (int i = 0; i < 40; ++i) identity.rows.push_back({{.column = i, .block = Mat3::Identity()}});
  const CoarseSpace space = build_coarse_space(points, identity);
  CoarseScratch scratch = build_scratch(space);
  const NodeVectorOf<float> r(node_stride * points.size(), 1.0F);
  NodeVectorOf<float> z(r.size(), 0.0F);
  add_coarse_correction_into(z, space, r, scratch);
  for (float value : z) EXPECT_TRUE(std::isfinite(value));
  EXPECT_GT(dot(z, r), 0.0);
}

}  // namespace
}  // namespace acus::numeric
