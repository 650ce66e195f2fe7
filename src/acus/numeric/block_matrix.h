// A sparse matrix of 3x3 blocks in rows, one row and column per node, with a symmetric pattern.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "acus/numeric/node_vector.h"

namespace acus::numeric {

// Which blocks exist. Row i holds columns column[row_start[i]] .. column[row_start[i + 1] - 1], in increasing
// order.
struct BlockPattern {
  std::vector<int> row_start;  // rows + 1 entries
  std::vector<int> column;
  std::vector<int> diagonal;  // where in `column` each row's diagonal stands; -1 if absent

  int rows() const { return static_cast<int>(row_start.size()) - 1; }
  int entries() const { return static_cast<int>(column.size()); }
  int find(int row, int col) const;  // the entry's index, or -1
};

// The pattern that couples all pairs of nodes of a group (here the four corners of a tetrahedron), for rows
// 0 .. rows - 1 and columns 0 .. columns - 1; pairs beyond are left out.
BlockPattern build_pattern(std::span<const std::array<int, 4>> groups, int rows, int columns);

// Blocks are column-major and padded: entry (r, c) of block b stands at 12 b + 4 c + r; the padding is zero.
inline constexpr int block_stride = 12;

// y = A x for the first y.size() / node_stride rows. `values` has block_stride doubles per entry of the
// pattern.
void multiply_into(NodeVector& y, const BlockPattern& pattern, std::span<const double> values,
                   const NodeVector& x);

// y += B^T diag(weight) B x, where row a of B holds one padded 3-vector per entry of the pattern
// (node_stride doubles): the rank-one stiffness of a nodal volume.
void add_gram_product_into(NodeVector& y, const BlockPattern& pattern, std::span<const double> rows,
                           std::span<const double> weight, const NodeVector& x);

// Inverts symmetric positive definite blocks in place. Returns false when one of them is not positive
// definite.
bool invert_blocks(std::span<double> blocks);

// y = D x for block-diagonal D, block_stride doubles per node.
void multiply_diagonal_into(NodeVector& y, std::span<const double> diagonal, const NodeVector& x);

}  // namespace acus::numeric
