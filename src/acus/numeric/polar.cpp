#include "acus/numeric/polar.h"

#include <Eigen/LU>
#include <Eigen/SVD>
#include <optional>

namespace acus::numeric {
namespace {

// Newton's iteration R <- (R + R^-T)/2 from R = F (Higham 1986), which converges quadratically to the polar
// factor of a regular F, or to a reflection if it is inverted. Nothing where it cannot be trusted: nearer to
// singular the sign of the determinant and the inverse drown in rounding.
std::optional<Mat3> rotation_by_newton(const Mat3& F) {
  constexpr int most_steps = 10;
  constexpr double converged = 1e-16;  // a correction of 1e-8 leaves its square
  constexpr double flattest = 1e-6;    // det / |F|^3: its rounding error is some 1e-10 of it
  const double size = F.norm();
  if (!(F.determinant() > flattest * size * size * size)) return std::nullopt;
  Mat3 R = F;
  for (int step = 0; step < most_steps; ++step) {
    const Mat3 next = 0.5 * (R + R.inverse().transpose());
    const double change = (next - R).squaredNorm();
    R = next;
    if (change < converged) return R;
  }
  return std::nullopt;
}

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
  if (const auto R = rotation_by_newton(F)) return *R;
  return rotation_by_svd(F);
}

}  // namespace acus::numeric
