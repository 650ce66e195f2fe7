// Dense linear algebra that tests compare with. Eigen's decompositions are dear to compile with sanitizers,
// so they are compiled once, here.
#pragma once

#include <Eigen/Core>
#include <random>

#include "acus/base/vec.h"

namespace acus::testing {

// x with A x = b, by Cholesky factors; A (n x n) is symmetric positive definite.
Eigen::VectorXd solve_positive(const Eigen::MatrixXd& A, const Eigen::VectorXd& b);

// A random symmetric matrix (n x n) of these n eigenvalues.
Eigen::MatrixXd symmetric_with(const Eigen::VectorXd& eigenvalues, std::mt19937& random);

// n values from lowest to highest, evenly spaced on a logarithmic scale.
Eigen::VectorXd spread(int n, double lowest, double highest);

// The largest eigenvalue of a symmetric matrix.
double largest_eigenvalue(const Eigen::Matrix4d& A);

// The rotation nearest to F, by its singular values; the axis of least stretch turns where F is a mirror.
Mat3 nearest_rotation(const Mat3& F);

}  // namespace acus::testing
