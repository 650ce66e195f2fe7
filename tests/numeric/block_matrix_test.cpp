// Block products against dense algebra.
#include "acus/numeric/block_matrix.h"

#include <gtest/gtest.h>

#include <random>
#include <set>

namespace acus::numeric {
namespace {

using Groups = std::vector<std::array<int, 4>>;

Groups random_groups(int count, int nodes, std::mt19937& random) {
  Groups groups;
  std::uniform_int_distribution<int> node(0, nodes - 1);
  while (static_cast<int>(groups.size()) < count) {
    std::set<int> corners;
    while (corners.size() < 4) corners.insert(node(random));
    std::array<int, 4> group{};
    std::copy(corners.begin(), corners.end(), group.begin());
    groups.push_back(group);
  }
  return groups;
}

// Random numbers in the first three of every four places, zero in the padding.
std::vector<double> padded_random(std::size_t size, std::mt19937& random) {
  std::normal_distribution<double> normal;
  std::vector<double> values(size, 0.0);
  for (std::size_t i = 0; i < size; ++i)
    if (i % 4 != 3) values[i] = normal(random);
  return values;
}

Eigen::VectorXd unpadded(const NodeVector& v) {
  Eigen::VectorXd dense(v.size() / node_stride * 3);
  for (int i = 0; i < dense.size() / 3; ++i) dense.segment<3>(3 * i) = at(v, i);
  return dense;
}

class BlockProducts : public ::testing::Test {
 protected:
  static constexpr int nodes = 23, free_nodes = 17;
  std::mt19937 random_{7};
  Groups groups_ = random_groups(20, nodes, random_);
  BlockPattern pattern_ = build_pattern(groups_, nodes, free_nodes);
  NodeVector x_ = padded_random(node_stride * free_nodes, random_);
};

TEST_F(BlockProducts, pattern_couples_just_the_pairs_of_each_group) {
  std::set<std::pair<int, int>> pairs;
  for (const auto& group : groups_)
    for (int i : group)
      for (int j : group)
        if (j < free_nodes) pairs.insert({i, j});
  EXPECT_EQ(pattern_.entries(), static_cast<int>(pairs.size()));
  for (int i = 0; i < nodes; ++i) {
    for (int j = 0; j < free_nodes; ++j) {
      const int entry = pattern_.find(i, j);
      EXPECT_EQ(entry >= 0, pairs.contains({i, j}));
      if (entry >= 0) {
        EXPECT_EQ(pattern_.column[entry], j);
      }
    }
    EXPECT_EQ(pattern_.diagonal[i], pattern_.find(i, i));
    EXPECT_TRUE(std::is_sorted(pattern_.column.begin() + pattern_.row_start[i],
                               pattern_.column.begin() + pattern_.row_start[i + 1]));
  }
}

TEST_F(BlockProducts, matrix_times_vector_is_the_dense_product) {
  const auto values = padded_random(static_cast<std::size_t>(pattern_.entries()) * block_stride, random_);
  Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(3 * free_nodes, 3 * free_nodes);
  for (int i = 0; i < free_nodes; ++i)
    for (int e = pattern_.row_start[i]; e < pattern_.row_start[i + 1]; ++e)
      for (int r = 0; r < 3; ++r)
        for (int c = 0; c < 3; ++c)
          dense(3 * i + r, 3 * pattern_.column[e] + c) = values[block_stride * e + 4 * c + r];
  NodeVector y(x_.size(), -1.0);
  multiply_into(y, pattern_, values, x_);
  const Eigen::VectorXd expected = dense * unpadded(x_);
  EXPECT_LT((unpadded(y) - expected).norm(), 1e-14 * expected.norm());
  for (int i = 0; i < free_nodes; ++i) EXPECT_EQ(y[node_stride * i + 3], 0.0);
}

TEST_F(BlockProducts, gram_product_is_the_dense_one_and_adds) {
  const auto rows = padded_random(static_cast<std::size_t>(pattern_.entries()) * node_stride, random_);
  std::uniform_real_distribution<double> uniform(0.1, 2.0);
  Eigen::VectorXd weight(nodes);
  for (double& w : weight) w = uniform(random_);
  Eigen::MatrixXd B = Eigen::MatrixXd::Zero(nodes, 3 * free_nodes);
  for (int a = 0; a < nodes; ++a)
    for (int e = pattern_.row_start[a]; e < pattern_.row_start[a + 1]; ++e)
      for (int c = 0; c < 3; ++c) B(a, 3 * pattern_.column[e] + c) = rows[node_stride * e + c];
  NodeVector y = padded_random(x_.size(), random_);
  const Eigen::VectorXd expected = unpadded(y) + B.transpose() * weight.asDiagonal() * (B * unpadded(x_));
  add_gram_product_into(y, pattern_, rows, {weight.data(), static_cast<std::size_t>(nodes)}, x_);
  EXPECT_LT((unpadded(y) - expected).norm(), 1e-13 * expected.norm());
}

TEST_F(BlockProducts, inverted_diagonal_blocks_undo_the_blocks) {
  std::vector<double> blocks(static_cast<std::size_t>(free_nodes) * block_stride, 0.0);
  NodeVector product(x_.size(), 0.0), back(x_.size(), 0.0);
  for (int i = 0; i < free_nodes; ++i) {
    const Mat3 L = Mat3::Random();
    const Mat3 D = L * L.transpose() + 0.1 * Mat3::Identity();
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 3; ++c) blocks[block_stride * i + 4 * c + r] = D(r, c);
    at(product, i) = D * at(x_, i);
  }
  ASSERT_TRUE(invert_blocks(blocks));
  multiply_diagonal_into(back, blocks, product);
  EXPECT_LT((unpadded(back) - unpadded(x_)).norm(), 1e-12 * unpadded(x_).norm());
}

TEST(InvertBlocks, says_when_a_block_is_not_positive_definite) {
  std::vector<double> blocks(2 * block_stride, 0.0);
  for (int c = 0; c < 3; ++c) blocks[5 * c] = blocks[block_stride + 5 * c] = 1.0;
  EXPECT_TRUE(invert_blocks(blocks));
  blocks[block_stride + 5] = -1.0;
  EXPECT_FALSE(invert_blocks(blocks));
}

TEST(NodeVectors, dot_and_sums_are_those_of_plain_loops) {
  std::mt19937 random(3);
  for (std::size_t count : {1, 2, 3, 8, 31}) {
    NodeVector a = padded_random(node_stride * count, random), b = padded_random(node_stride * count, random);
    EXPECT_NEAR(dot(a, b), unpadded(a).dot(unpadded(b)), 1e-14 * static_cast<double>(count));
    const Eigen::VectorXd sum = unpadded(a) + 0.7 * unpadded(b);
    NodeVector y = a;
    add_scaled_into(y, 0.7, b);
    EXPECT_LT((unpadded(y) - sum).norm(), 1e-14);
    y = b;
    scale_and_add_into(y, 0.7, a);
    EXPECT_LT((unpadded(y) - sum).norm(), 1e-14);
  }
}

}  // namespace
}  // namespace acus::numeric
