// The lower half of a sparse symmetric matrix of 3x3 blocks, a row for each node.
#pragma once

#include <vector>

#include "acus/base/vec.h"

namespace acus::numeric {

struct LowerBlocks {
  struct Entry {
    int column = 0;
    Mat3 block = Mat3::Zero();
  };
  std::vector<std::vector<Entry>> rows;  // columns ascend, the last is the row's own
};

// The inverses of its diagonal blocks: [rows][3 columns][4], for multiply_blocks_into.
std::vector<float> inverse_diagonal(const LowerBlocks& a);

}  // namespace acus::numeric
