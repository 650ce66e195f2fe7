#include "acus/numeric/block_matrix.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cassert>

#include "acus/numeric/simd.h"

namespace acus::numeric {
namespace {

using PaddedBlock = Eigen::Map<Mat3, 0, Eigen::OuterStride<4>>;

}  // namespace

int BlockPattern::find(int row, int col) const {
  const auto first = column.begin() + row_start[row];
  const auto last = column.begin() + row_start[row + 1];
  const auto it = std::lower_bound(first, last, col);
  return it != last && *it == col ? static_cast<int>(it - column.begin()) : -1;
}

BlockPattern build_pattern(std::span<const std::array<int, 4>> groups, int rows, int columns) {
  std::vector<std::vector<int>> neighbours(static_cast<std::size_t>(rows));
  for (const auto& group : groups)
    for (int i : group)
      for (int j : group)
        if (i < rows && j < columns) neighbours[i].push_back(j);
  BlockPattern pattern;
  pattern.row_start.assign(1, 0);
  for (int i = 0; i < rows; ++i) {
    auto& row = neighbours[i];
    std::sort(row.begin(), row.end());
    row.erase(std::unique(row.begin(), row.end()), row.end());
    pattern.column.insert(pattern.column.end(), row.begin(), row.end());
    pattern.row_start.push_back(static_cast<int>(pattern.column.size()));
  }
  for (int i = 0; i < rows; ++i) pattern.diagonal.push_back(pattern.find(i, i));
  return pattern;
}

ACUS_KERNEL void multiply_into(NodeVector& y, const BlockPattern& pattern, std::span<const double> values,
                               const NodeVector& x) {
  const int* start = pattern.row_start.data();
  const int* column = pattern.column.data();
  const double* block = values.data();
  const double* px = x.data();
  double* py = y.data();
  const int rows = static_cast<int>(y.size()) / node_stride;
  for (int i = 0; i < rows; ++i) {
    Lane4 s0{}, s1{}, s2{};
    for (int e = start[i]; e < start[i + 1]; ++e) {
      const double* b = block + static_cast<std::ptrdiff_t>(block_stride) * e;
      const double* xj = px + node_stride * column[e];
      s0 += load4(b) * xj[0];
      s1 += load4(b + 4) * xj[1];
      s2 += load4(b + 8) * xj[2];
    }
    store4(py + node_stride * i, s0 + s1 + s2);
  }
}

ACUS_KERNEL void add_gram_product_into(NodeVector& y, const BlockPattern& pattern,
                                       std::span<const double> rows, std::span<const double> weight,
                                       const NodeVector& x) {
  const int* start = pattern.row_start.data();
  const int* column = pattern.column.data();
  const double* b = rows.data();
  const double* px = x.data();
  double* py = y.data();
  const int n = pattern.rows();
  for (int a = 0; a < n; ++a) {
    Lane4 s{};
    for (int e = start[a]; e < start[a + 1]; ++e)
      s += load4(b + node_stride * e) * load4(px + node_stride * column[e]);
    const double w = weight[a] * sum(s);
    for (int e = start[a]; e < start[a + 1]; ++e) {
      double* yj = py + node_stride * column[e];
      store4(yj, load4(yj) + w * load4(b + node_stride * e));
    }
  }
}

bool invert_blocks(std::span<double> blocks) {
  for (std::size_t at = 0; at < blocks.size(); at += block_stride) {
    PaddedBlock block(blocks.data() + at);
    const Eigen::LLT<Mat3> factor(block);
    if (factor.info() != Eigen::Success) return false;
    block = factor.solve(Mat3::Identity());
  }
  return true;
}

ACUS_KERNEL void multiply_diagonal_into(NodeVector& y, std::span<const double> diagonal,
                                        const NodeVector& x) {
  const double* d = diagonal.data();
  const double* px = x.data();
  double* py = y.data();
  const std::size_t n = x.size() / node_stride;
  for (std::size_t i = 0; i < n; ++i) {
    const double* b = d + block_stride * i;
    const double* xi = px + node_stride * i;
    store4(py + node_stride * i, load4(b) * xi[0] + load4(b + 4) * xi[1] + load4(b + 8) * xi[2]);
  }
}

}  // namespace acus::numeric
