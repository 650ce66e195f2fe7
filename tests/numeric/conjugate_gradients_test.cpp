// Conjugate gradients against dense solves, and what they say when there is no answer.
#include "acus/numeric/conjugate_gradients.h"

#include <gtest/gtest.h>

#include <random>

#include "tests/oracles/dense.h"

namespace acus::numeric {
namespace {

constexpr int nodes = 20;
constexpr int size = node_stride * nodes;

Eigen::Map<const Eigen::VectorXd> dense(const NodeVector& v) { return {v.data(), size}; }

// A dense operator on padded vectors whose padding rows and columns are the identity, counting its uses.
struct System {
  Eigen::MatrixXd A = Eigen::MatrixXd::Identity(size, size);
  NodeVector b = NodeVector(size, 0.0);
  mutable int products = 0;

  explicit System(const Eigen::VectorXd& eigenvalues, unsigned seed = 1) {
    std::mt19937 random(seed);
    std::normal_distribution<double> normal;
    const Eigen::MatrixXd inner = testing::symmetric_with(eigenvalues, random);
    const auto place = [](int i) { return node_stride * (i / 3) + i % 3; };
    for (int i = 0; i < 3 * nodes; ++i) {
      b[place(i)] = normal(random);
      for (int j = 0; j < 3 * nodes; ++j) A(place(i), place(j)) = inner(i, j);
    }
  }
  SolveOutcome solve(NodeVector& x, double target, int max_iterations) const {
    SolveScratch<double> scratch(nodes);
    return solve_into(
        x, b, target, max_iterations, scratch,
        [&](NodeVector& y, const NodeVector& p) {
          ++products;
          Eigen::Map<Eigen::VectorXd>(y.data(), size) = A * dense(p);
        },
        [&](NodeVector& z, const NodeVector& r) {
          for (int i = 0; i < size; ++i) z[i] = r[i] / std::max(std::abs(A(i, i)), 1e-3);
        });
  }
};

Eigen::VectorXd spread(double lowest, double highest) { return testing::spread(3 * nodes, lowest, highest); }

TEST(ConjugateGradients, find_the_dense_solution_from_any_start) {
  const System system(spread(1.0, 1e4));
  for (double start : {0.0, 3.0}) {
    NodeVector x(size, start);
    for (int i = 0; i < nodes; ++i) x[node_stride * i + 3] = 0.0;
    const SolveOutcome outcome = system.solve(x, 1e-10, 500);
    EXPECT_FALSE(outcome.broke_down);
    const Eigen::VectorXd expected = testing::solve_positive(system.A, dense(system.b));
    EXPECT_LT((dense(x) - expected).norm(), 1e-9 * expected.norm());
  }
}

TEST(ConjugateGradients, true_residual_meets_the_target) {
  const System system(spread(1.0, 1e3));
  for (double target : {1e-2, 1e-5, 1e-9}) {
    NodeVector x(size, 0.0);
    const SolveOutcome outcome = system.solve(x, target, 500);
    const double residual = (dense(system.b) - system.A * dense(x)).norm();
    EXPECT_LT(residual, 1.01 * target);
    EXPECT_NEAR(outcome.residual_norm, residual, 0.01 * target);
  }
}

// Without smoothing the residual of this system rises to four times its start.
TEST(ConjugateGradients, never_leave_a_larger_residual_than_before) {
  const System system(spread(1.0, 1e5));
  double before = dense(system.b).norm();
  for (int iterations = 1; iterations < 40; ++iterations) {
    NodeVector x(size, 0.0);
    system.solve(x, 1e-12, iterations);
    const double residual = (dense(system.b) - system.A * dense(x)).norm();
    EXPECT_LE(residual, before * (1.0 + 1e-9)) << iterations;
    before = residual;
  }
}

TEST(ConjugateGradients, end_after_as_many_steps_as_there_are_distinct_eigenvalues) {
  Eigen::VectorXd values = Eigen::VectorXd::Constant(3 * nodes, 2.0);
  System system(values);
  NodeVector x(size, 0.0);
  EXPECT_EQ(system.solve(x, 1e-10, 500).iterations, 1);
}

TEST(ConjugateGradients, report_breakdown_on_an_indefinite_matrix) {
  Eigen::VectorXd values = spread(1.0, 10.0);
  values.head(10) *= -1.0;
  const System system(values);
  NodeVector x(size, 0.0);
  const SolveOutcome outcome = system.solve(x, 1e-10, 500);
  EXPECT_TRUE(outcome.broke_down);
  for (double value : x) EXPECT_TRUE(std::isfinite(value));
}

TEST(ConjugateGradients, report_breakdown_on_numbers_that_are_none) {
  System system(spread(1.0, 10.0));
  system.b[5] = std::nan("");
  NodeVector x(size, 0.0);
  EXPECT_TRUE(system.solve(x, 1e-10, 500).broke_down);
}

TEST(ConjugateGradients, stop_at_the_largest_count_and_say_what_is_left) {
  const System system(spread(1.0, 1e6));
  NodeVector x(size, 0.0);
  const SolveOutcome outcome = system.solve(x, 1e-12, 3);
  EXPECT_EQ(outcome.iterations, 3);
  EXPECT_FALSE(outcome.broke_down);
  EXPECT_NEAR(outcome.residual_norm, (dense(system.b) - system.A * dense(x)).norm(), 1e-9);
}

TEST(ConjugateGradients, return_at_once_for_nothing_to_solve) {
  System system(spread(1.0, 10.0));
  std::fill(system.b.begin(), system.b.end(), 0.0);
  NodeVector x(size, 0.0);
  const SolveOutcome outcome = system.solve(x, 0.0, 500);
  EXPECT_EQ(outcome.iterations, 0);
  EXPECT_FALSE(outcome.broke_down);
  EXPECT_EQ(system.products, 1);
  EXPECT_EQ(x, NodeVector(size, 0.0));
}

}  // namespace
}  // namespace acus::numeric
