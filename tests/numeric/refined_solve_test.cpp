// Solves in single precision that must end as good as dense ones in double.
#include "acus/numeric/refined_solve.h"

#include <gtest/gtest.h>

#include <random>

#include "tests/oracles/dense.h"

namespace acus::numeric {
namespace {

constexpr int nodes = 40;
constexpr int size = node_stride * nodes;

// A dense symmetric positive definite operator of given condition, in both precisions.
class System {
 public:
  explicit System(double condition) {
    std::mt19937 random(5);
    std::normal_distribution<double> normal;
    A = testing::symmetric_with(testing::spread(size, 1.0, condition), random);
    single_ = A.cast<float>();
    for (double& value : b) value = normal(random);
  }
  void operator()(NodeVector& y, const NodeVector& x) const {
    ++exact_products;
    Eigen::Map<Eigen::VectorXd>(y.data(), size) = A * dense(x);
  }
  void operator()(NodeVectorOf<float>& y, const NodeVectorOf<float>& x) const {
    Eigen::Map<Eigen::VectorXf>(y.data(), size) = single_ * Eigen::Map<const Eigen::VectorXf>(x.data(), size);
  }
  SolveOutcome solve(NodeVector& x, double target, int most_iterations = 5000) const {
    RefinedScratch scratch(nodes);
    NodeVector residual(size);
    (*this)(residual, x);
    scale_and_add_into(residual, -1.0, b);
    exact_products = 0;
    const SolveOutcome outcome =
        improve_refined_into(x, residual, target, most_iterations, trusts, scratch, *this,
                             [](NodeVectorOf<float>& z, const NodeVectorOf<float>& r) { z = r; });
    recursive = std::sqrt(dot(residual, residual));
    return outcome;
  }
  static Eigen::Map<const Eigen::VectorXd> dense(const NodeVector& v) { return {v.data(), size}; }
  double residual(const NodeVector& x) const { return (dense(b) - A * dense(x)).norm(); }

  Eigen::MatrixXd A;
  NodeVector b = NodeVector(size, 0.0);
  bool trusts = true;  // the recursion of a round
  mutable int exact_products = 0;
  mutable double recursive = 0.0;  // norm of the residual that the last solve left

 private:
  Eigen::MatrixXf single_;
};

TEST(RefinedSolve, reaches_residuals_that_single_precision_cannot) {
  for (double condition : {10.0, 1e3}) {
    const System system(condition);
    const double norm = system.dense(system.b).norm();
    NodeVector x(size, 0.0);
    const SolveOutcome outcome = system.solve(x, 1e-12 * norm);
    EXPECT_FALSE(outcome.broke_down);
    EXPECT_LE(system.residual(x), 1.1e-12 * norm);
    const Eigen::VectorXd exact = testing::solve_positive(system.A, system.dense(system.b));
    EXPECT_LT((system.dense(x) - exact).norm(), 1e-11 * condition * exact.norm());
  }
}

// Whatever it reports without having looked must be what one finds who looks.
TEST(RefinedSolve, residual_that_it_did_not_check_is_the_real_one) {
  const System system(1e3);
  const double norm = system.dense(system.b).norm();
  for (double fall : {0.3, 1e-1, 1e-2, 1.2e-3}) {
    NodeVector x(size, 0.0);
    const SolveOutcome outcome = system.solve(x, fall * norm);
    EXPECT_EQ(system.exact_products, 0) << fall;
    EXPECT_LE(system.residual(x), fall * norm);
    EXPECT_NEAR(outcome.residual_norm, system.residual(x), 0.01 * fall * norm);
    EXPECT_NEAR(system.recursive, system.residual(x), 0.01 * fall * norm);
  }
  NodeVector x(size, 0.0);
  system.solve(x, 1e-4 * norm);
  EXPECT_EQ(system.exact_products, 1);  // below 1e-3 it looks
}

// A residual that is carried on, and solved for again far more exactly, must have no more in it than doubles.
TEST(RefinedSolve, looks_after_every_round_where_the_recursion_is_not_trusted) {
  System system(1e3);
  system.trusts = false;
  const double norm = system.dense(system.b).norm();
  for (double fall : {0.3, 1e-2}) {
    NodeVector x(size, 0.0);
    system.solve(x, fall * norm);
    EXPECT_EQ(system.exact_products, 1) << fall;
    EXPECT_NEAR(system.recursive, system.residual(x), 1e-13 * norm);
  }
}

TEST(RefinedSolve, leaves_a_start_value_that_is_good_enough_alone) {
  const System system(10.0);
  NodeVector x(size, 0.0);
  system.solve(x, 1e-10);
  const NodeVector before = x;
  const SolveOutcome outcome = system.solve(x, 1e-9);
  EXPECT_EQ(outcome.iterations, 0);
  EXPECT_EQ(x, before);
}

TEST(RefinedSolve, ends_where_no_number_of_rounds_can_reach_the_target) {
  const System system(1e3);
  NodeVector x(size, 0.0);
  const SolveOutcome outcome = system.solve(x, 0.0, 3000);
  EXPECT_GE(outcome.iterations, 3000);
  EXPECT_LT(system.residual(x), 1e-12 * system.dense(system.b).norm());
}

TEST(RefinedSolve, stands_loads_far_outside_the_range_of_floats) {
  const System system(10.0);
  System tiny = system;
  for (double& value : tiny.b) value *= 1e-60;
  NodeVector x(size, 0.0);
  EXPECT_FALSE(tiny.solve(x, 1e-70).broke_down);
  EXPECT_LE(tiny.residual(x), 1.1e-70);
}

TEST(RefinedSolve, in_double_throughout_gives_the_dense_solution) {
  const System system(1e3);
  const double norm = system.dense(system.b).norm();
  SolveScratch<double> exact(nodes);
  SolveScratch<float> single(nodes);
  NodeVector x(size, 0.0), residual = system.b;
  const SolveOutcome outcome =
      improve_in_double_into(x, residual, 1e-11 * norm, 5000, exact, single, system,
                             [](NodeVectorOf<float>& z, const NodeVectorOf<float>& r) { z = r; });
  EXPECT_FALSE(outcome.broke_down);
  EXPECT_LE(system.residual(x), 1.1e-11 * norm);
  EXPECT_NEAR(std::sqrt(dot(residual, residual)), system.residual(x), 1e-12 * norm);
  const Eigen::VectorXd solution = testing::solve_positive(system.A, system.dense(system.b));
  EXPECT_LT((system.dense(x) - solution).norm(), 1e-7 * solution.norm());
}

TEST(RefinedSolve, says_so_when_a_number_is_not_finite) {
  System system(10.0);
  system.b[5] = std::numeric_limits<double>::quiet_NaN();
  NodeVector x(size, 0.0);
  EXPECT_TRUE(system.solve(x, 1e-6).broke_down);
}

}  // namespace
}  // namespace acus::numeric
