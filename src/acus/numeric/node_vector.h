// Vectors with one padded 3-vector per node: four numbers, the last zero, so that a node is one load.
#pragma once

#include <span>
#include <vector>

#include "acus/base/team.h"
#include "acus/base/vec.h"

namespace acus::numeric {

inline constexpr int node_stride = 4;

template <class Real>
using NodeVectorOf = std::vector<Real>;  // node_stride numbers per node
using NodeVector = NodeVectorOf<double>;

template <class Real>
Eigen::Map<Eigen::Matrix<Real, 3, 1>> at(NodeVectorOf<Real>& v, int node) {
  return Eigen::Map<Eigen::Matrix<Real, 3, 1>>(v.data() + node_stride * node);
}
template <class Real>
Eigen::Map<const Eigen::Matrix<Real, 3, 1>> at(const NodeVectorOf<Real>& v, int node) {
  return Eigen::Map<const Eigen::Matrix<Real, 3, 1>>(v.data() + node_stride * node);
}

// Sums run in one fixed order, so they are the same on every machine and for any number of threads
// (pieces.h); those of floats are kept in double.
double dot(std::span<const double> a, std::span<const double> b, const Team& team = one_thread);
double dot(std::span<const float> a, std::span<const float> b, const Team& team = one_thread);
// y = x
void copy_into(std::span<double> y, std::span<const double> x, const Team& team = one_thread);
void copy_into(std::span<float> y, std::span<const float> x, const Team& team = one_thread);
// y += factor x
void add_scaled_into(std::span<double> y, double factor, std::span<const double> x,
                     const Team& team = one_thread);
void add_scaled_into(std::span<float> y, double factor, std::span<const float> x,
                     const Team& team = one_thread);
void add_scaled_into(std::span<double> y, double factor, std::span<const float> x,
                     const Team& team = one_thread);
// y = x + factor y
void scale_and_add_into(std::span<double> y, double factor, std::span<const double> x,
                        const Team& team = one_thread);
void scale_and_add_into(std::span<float> y, double factor, std::span<const float> x,
                        const Team& team = one_thread);
// y = factor x
void scale_into(std::span<float> y, double factor, std::span<const double> x, const Team& team = one_thread);
void scale_into(std::span<double> y, double factor, std::span<const float> x, const Team& team = one_thread);
// y = D x for a 3x3 block per node, column by column, padded as nodes are.
void multiply_blocks_into(std::span<float> y, std::span<const float> block, std::span<const float> x,
                          const Team& team = one_thread);
// x += step direction, residual -= step product; returns the square of the residual's norm.
double advance_into(std::span<double> x, std::span<double> residual, double step,
                    std::span<const double> direction, std::span<const double> product,
                    const Team& team = one_thread);
double advance_into(std::span<float> x, std::span<float> residual, double step,
                    std::span<const float> direction, std::span<const float> product,
                    const Team& team = one_thread);
// x += share (other - x), residual likewise; returns the square of the residual's norm.
double approach_into(std::span<double> x, std::span<double> residual, double share,
                     std::span<const double> other, std::span<const double> other_residual,
                     const Team& team = one_thread);
double approach_into(std::span<float> x, std::span<float> residual, double share,
                     std::span<const float> other, std::span<const float> other_residual,
                     const Team& team = one_thread);

}  // namespace acus::numeric
