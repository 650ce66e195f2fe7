// Small fixed-size vectors, the words every folder speaks.
#pragma once

#include <Eigen/Dense>

namespace acus {

using Vec3 = Eigen::Vector3d;
using Mat3 = Eigen::Matrix3d;

}  // namespace acus
