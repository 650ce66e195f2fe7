#include "acus/numeric/polar.h"

#include <Eigen/SVD>
#include <algorithm>

namespace acus::numeric {
namespace {

// Slow and safe: R = U diag(1, 1, det(U V^T)) V^T.
Mat3 rotation_by_svd(const Mat3& F) {
  const double scale = F.cwiseAbs().maxCoeff();
  if (scale == 0.0) return Mat3::Identity();
  const Eigen::JacobiSVD<Mat3> svd(F / scale, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Mat3 U = svd.matrixU();
  if ((U * svd.matrixV().transpose()).determinant() < 0.0) U.col(2) = -U.col(2);  // least stretch is last
  return U * svd.matrixV().transpose();
}

}  // namespace

Mat3 rotation_of(const Mat3& F) {
  Mat3 R = F;
  for (int step = 0; step < newton_polar_max_steps; ++step) {
    double determinant = 0.0;
    const double change = newton_polar_step(R.data(), determinant);
    if (step == 0 && !newton_polar_holds(determinant, F.squaredNorm())) break;
    if (change < newton_polar_converged) return R;
  }
  return rotation_by_svd(F);
}

}  // namespace acus::numeric
