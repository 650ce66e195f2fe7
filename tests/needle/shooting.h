// The buckled column by shooting: theta'' = -P sin(theta) - Q cos(theta) on 0 <= s <= 1 by Runge-Kutta steps,
// Newton's method on the end conditions. EI = l = 1. Shares nothing with src/acus/needle but the names of the
// supports.
#pragma once

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "acus/needle/needle_spec.h"

namespace shooting {

using acus::needle::Support;
using std::numbers::pi;
using State = Eigen::Array<double, 5, 1>;  // theta, theta', x, y, energy

struct Buckled {
  double d;
  double load;     // P, along the axis
  double lateral;  // Q
  double bow;      // largest distance from the axis (clamped_free: of the tip from the root)
  double tip_slope;
  double energy;
};

// Start at the tip, but for clamped_clamped at the hub. The unknowns are P, the start's slope
// (clamped_clamped: curvature) and, clamped_pinned only, Q.
class Column {
 public:
  explicit Column(Support support) : support_(support) {
    const double d = first_shortening;
    switch (support) {
      case Support::pinned_pinned:
        unknowns_ = {pi * pi, 2.0 * std::sqrt(d), 0.0};
        break;
      case Support::clamped_clamped:
        unknowns_ = {4.0 * pi * pi, 4.0 * pi * std::sqrt(d), 0.0};
        break;
      case Support::clamped_free:
        unknowns_ = {pi * pi / 4.0, 2.0 * std::sqrt(d), 0.0};
        break;
      case Support::clamped_pinned: {
        const double z = 4.493409457909064;
        const double slope = 2.0 * std::sqrt(d) / std::abs(std::sin(z));
        unknowns_ = {z * z, slope * (1.0 - std::cos(z)), z * z * slope * std::cos(z)};
      }
    }
  }

  static constexpr double first_shortening = 1e-3;

  // Follows the branch from the last solution to the shortening d.
  Buckled at(double d) {
    while (reached_ < d) {
      reached_ = std::min(d, reached_ + 0.02);
      for (int i = 0; i < 5; ++i) correct(reached_);
    }
    return result(reached_);
  }

 private:
  State rate(const State& u) const {
    const double s = std::sin(u[0]);
    const double c = std::cos(u[0]);
    State r;
    r << u[1], -unknowns_[0] * s - unknowns_[2] * c, c, s, 0.5 * u[1] * u[1];
    return r;
  }

  std::vector<State> integrate() const {
    constexpr int steps = 1500;
    constexpr double h = 1.0 / steps;
    State u = State::Zero();
    u[support_ == Support::clamped_clamped ? 1 : 0] = unknowns_[1];
    std::vector<State> path{u};
    for (int i = 0; i < steps; ++i) {
      const State a = rate(u);
      const State b = rate(u + 0.5 * h * a);
      const State c = rate(u + 0.5 * h * b);
      const State e = rate(u + h * c);
      u += h / 6.0 * (a + 2.0 * b + 2.0 * c + e);
      path.push_back(u);
    }
    return path;
  }

  Eigen::Vector3d miss(double d) const {
    const State end = integrate().back();
    const double moment_or_slope = support_ == Support::pinned_pinned ? end[1] : end[0];
    const double across = support_ == Support::clamped_pinned ? end[3] : unknowns_[2];
    return {end[2] - (1.0 - d), moment_or_slope, across};
  }

  void correct(double d) {
    const Eigen::Vector3d f = miss(d);
    Eigen::Matrix3d jacobian;
    for (int j = 0; j < 3; ++j) {
      constexpr double h = 1e-6;
      const double kept = unknowns_[j];
      unknowns_[j] = kept + h;
      const Eigen::Vector3d above = miss(d);
      unknowns_[j] = kept - h;
      jacobian.col(j) = (above - miss(d)) / (2.0 * h);
      unknowns_[j] = kept;
    }
    unknowns_ -= jacobian.partialPivLu().solve(f);
  }

  Buckled result(double d) const {
    const std::vector<State> path = integrate();
    double bow = 0.0;
    for (const State& u : path) bow = std::max(bow, std::abs(u[3]));
    const double slope = support_ == Support::clamped_clamped ? 0.0 : unknowns_[1];
    return {d, unknowns_[0], std::abs(unknowns_[2]), bow, slope, path.back()[4]};
  }

  Support support_;
  Eigen::Vector3d unknowns_;
  double reached_ = first_shortening - 0.02;
};

}  // namespace shooting
