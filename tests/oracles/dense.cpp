#include "tests/oracles/dense.h"

#include <Eigen/Dense>

namespace acus::testing {

Eigen::VectorXd solve_positive(const Eigen::MatrixXd& A, const Eigen::VectorXd& b) {
  return A.llt().solve(b);
}

Eigen::MatrixXd symmetric_with(const Eigen::VectorXd& eigenvalues, std::mt19937& random) {
  const Eigen::Index n = eigenvalues.size();
  std::normal_distribution<double> normal;
  Eigen::MatrixXd G(n, n);
  for (double& g : G.reshaped()) g = normal(random);
  const Eigen::MatrixXd Q = Eigen::HouseholderQR<Eigen::MatrixXd>(G).householderQ();
  return Q * eigenvalues.asDiagonal() * Q.transpose();
}

Eigen::VectorXd spread(int n, double lowest, double highest) {
  return Eigen::VectorXd::LinSpaced(n, std::log(lowest), std::log(highest)).array().exp();
}

double largest_eigenvalue(const Eigen::Matrix4d& A) {
  return Eigen::SelfAdjointEigenSolver<Eigen::Matrix4d>(A, Eigen::EigenvaluesOnly).eigenvalues()[3];
}

Mat3 nearest_rotation(const Mat3& F) {
  const Eigen::JacobiSVD<Mat3> svd(F, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const Vec3 signs(1.0, 1.0, (svd.matrixU() * svd.matrixV().transpose()).determinant());
  return svd.matrixU() * signs.asDiagonal() * svd.matrixV().transpose();
}

}  // namespace acus::testing
