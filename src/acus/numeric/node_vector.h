// Vectors with one padded 3-vector per node: four doubles, the last always zero, so that a node is one load.
#pragma once

#include <span>
#include <vector>

#include "acus/base/vec.h"

namespace acus::numeric {

inline constexpr int node_stride = 4;

using NodeVector = std::vector<double>;  // node_stride doubles per node

inline Eigen::Map<Vec3> at(NodeVector& v, int node) {
  return Eigen::Map<Vec3>(v.data() + node_stride * node);
}
inline Eigen::Map<const Vec3> at(const NodeVector& v, int node) {
  return Eigen::Map<const Vec3>(v.data() + node_stride * node);
}

// Sums run in one fixed order, so they are the same on every machine.
double dot(std::span<const double> a, std::span<const double> b);
void add_scaled_into(NodeVector& y, double factor, const NodeVector& x);     // y += factor x
void scale_and_add_into(NodeVector& y, double factor, const NodeVector& x);  // y = x + factor y

}  // namespace acus::numeric
