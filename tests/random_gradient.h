// Deformation gradients of every kind: ordinary, huge, tiny, inverted, flat, line-like, zero, nearly
// singular, mirrored.
#pragma once

#include <cmath>
#include <random>

#include "acus/base/vec.h"

namespace acus::testing {

// A million where the code runs at full speed; the sanitizers make each some fifty times dearer.
#ifdef ACUS_SANITIZED
inline constexpr int gradient_count = 20'000;
#else
inline constexpr int gradient_count = 1'000'000;
#endif

// The i-th of a sequence that goes through all kinds.
inline Mat3 random_gradient(int i, std::mt19937& random) {
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> exponent(-12.0, 12.0);
  const auto vec = [&] { return Vec3(normal(random), normal(random), normal(random)); };
  Mat3 F;
  F << vec(), vec(), vec();
  const double tiny = std::pow(10.0, exponent(random) - 4.0);  // 1e-16 .. 1e8
  switch (i % 10) {
    case 0:
      return F;
    case 1:
      return std::pow(10.0, exponent(random)) * F;
    case 2:
      return F.determinant() > 0.0 ? Mat3(-F) : F;
    case 3:
      F.col(2) = normal(random) * F.col(0) + normal(random) * F.col(1);
      return F;
    case 4:
      return vec() * vec().transpose();
    case 5:
      return i % 1000 == 5 ? Mat3(Mat3::Zero()) : Mat3(Mat3::Identity() + 1e-3 * F);
    case 6:
      return vec() * vec().transpose() + vec() * vec().transpose() + tiny * F;
    case 7:
      return vec() * vec().transpose() + tiny * F;
    case 8:
      return Mat3::Identity() - 2.0 * vec().normalized() * vec().normalized().transpose() +
             std::min(tiny, 1.0) * F;
    default:
      F.row(i / 10 % 3) *= std::pow(10.0, exponent(random));
      return F;
  }
}

}  // namespace acus::testing
