// Sums and products of node vectors against plain loops.
#include "acus/numeric/node_vector.h"

#include <gtest/gtest.h>

#include <random>

namespace acus::numeric {
namespace {

template <class Real>
class NodeVectors : public ::testing::Test {
 protected:
  // Random numbers in the first three of every four places, zero in the padding.
  NodeVectorOf<Real> padded_random(std::size_t nodes) {
    NodeVectorOf<Real> values(node_stride * nodes, Real{});
    for (std::size_t i = 0; i < values.size(); ++i)
      if (i % node_stride != 3) values[i] = static_cast<Real>(normal_(random_));
    return values;
  }
  static Eigen::VectorXd dense(const NodeVectorOf<Real>& v) {
    return Eigen::Map<const Eigen::VectorX<Real>>(v.data(), static_cast<int>(v.size()))
        .template cast<double>();
  }
  static constexpr double rounding = 8.0 * std::numeric_limits<Real>::epsilon();

 private:
  std::mt19937 random_{3};
  std::normal_distribution<double> normal_;
};
using Reals = ::testing::Types<double, float>;
TYPED_TEST_SUITE(NodeVectors, Reals);

constexpr std::size_t node_counts[] = {1, 2, 3, 7, 8, 9, 31, 3001, 4000};  // the last two are cut into pieces

TYPED_TEST(NodeVectors, dot_is_the_sum_of_products_kept_in_double) {
  for (std::size_t count : node_counts) {
    const auto a = this->padded_random(count), b = this->padded_random(count);
    EXPECT_NEAR(dot(a, b), this->dense(a).dot(this->dense(b)), 1e-14 * static_cast<double>(count));
  }
}

TYPED_TEST(NodeVectors, threads_change_no_bits) {
  const std::size_t count = node_counts[7];
  const auto a = this->padded_random(count), b = this->padded_random(count);
  for (int threads : {2, 3}) {
    const Team team(threads);
    EXPECT_EQ(dot(a, b, team), dot(a, b));
    auto x = a, y = a, residual = b, other_residual = b;
    EXPECT_EQ(advance_into(x, residual, 0.3, a, b, team), advance_into(y, other_residual, 0.3, a, b));
    EXPECT_EQ(approach_into(x, residual, 0.7, b, a, team), approach_into(y, other_residual, 0.7, b, a));
    add_scaled_into(x, 0.7, b, team), add_scaled_into(y, 0.7, b);
    scale_and_add_into(x, 0.7, b, team), scale_and_add_into(y, 0.7, b);
    EXPECT_EQ(x, y);
    EXPECT_EQ(residual, other_residual);
    copy_into(x, b, team);
    EXPECT_EQ(x, b);
  }
}

TYPED_TEST(NodeVectors, sums_are_those_of_plain_loops) {
  for (std::size_t count : node_counts) {
    const auto a = this->padded_random(count), b = this->padded_random(count);
    const Eigen::VectorXd sum = this->dense(a) + 0.7 * this->dense(b);
    auto y = a;
    add_scaled_into(y, 0.7, b);
    EXPECT_LT((this->dense(y) - sum).norm(), this->rounding * sum.norm());
    y = b;
    scale_and_add_into(y, 0.7, a);
    EXPECT_LT((this->dense(y) - sum).norm(), this->rounding * sum.norm());
  }
}

TYPED_TEST(NodeVectors, advance_moves_both_vectors_and_returns_the_square_of_the_new_residual) {
  for (std::size_t count : node_counts) {
    auto x = this->padded_random(count), residual = this->padded_random(count);
    const auto direction = this->padded_random(count), product = this->padded_random(count);
    const Eigen::VectorXd x1 = this->dense(x) + 0.3 * this->dense(direction);
    const Eigen::VectorXd r1 = this->dense(residual) - 0.3 * this->dense(product);
    const double square = advance_into(x, residual, 0.3, direction, product);
    EXPECT_LT((this->dense(x) - x1).norm(), this->rounding * x1.norm());
    EXPECT_LT((this->dense(residual) - r1).norm(), this->rounding * r1.norm());
    EXPECT_NEAR(square, r1.squaredNorm(), 4.0 * this->rounding * r1.squaredNorm());
  }
}

TEST(NodeVector, goes_from_double_to_float_and_back_in_a_sum) {
  const NodeVector x = {1.0, 2.0, 3.0, 0.0};
  NodeVectorOf<float> single(4);
  scale_into(single, 0.5, x);
  EXPECT_EQ(single, (NodeVectorOf<float>{0.5F, 1.0F, 1.5F, 0.0F}));
  NodeVector y = x;
  add_scaled_into(y, 1e-9, single);
  EXPECT_EQ(y[2], 3.0 + 1e-9 * 1.5);  // floats alone would lose it
}

TEST(NodeVector, is_multiplied_by_a_block_of_each_node) {
  const NodeVectorOf<float> x = {1.0F, 2.0F, 3.0F, 0.0F, 4.0F, 5.0F, 6.0F, 0.0F};
  const NodeVectorOf<float> block = {2.0F, 1.0F, 0.0F, 0.0F, 0.0F, 2.0F,
                                     0.0F, 0.0F, 0.0F, 4.0F, 2.0F, 0.0F,  // columns (2 1 0), (0 2 0), (0 4 2)
                                     3.0F, 0.0F, 0.0F, 0.0F, 0.0F, 3.0F,
                                     0.0F, 0.0F, 0.0F, 0.0F, 3.0F, 0.0F};
  NodeVectorOf<float> y(8);
  multiply_blocks_into(y, block, x);
  EXPECT_EQ(y, (NodeVectorOf<float>{2.0F, 17.0F, 6.0F, 0.0F, 12.0F, 15.0F, 18.0F, 0.0F}));
}

}  // namespace
}  // namespace acus::numeric
