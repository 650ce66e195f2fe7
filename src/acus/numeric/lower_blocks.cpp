#include "acus/numeric/lower_blocks.h"

#include "acus/numeric/node_vector.h"

namespace acus::numeric {

std::vector<float> inverse_diagonal(const LowerBlocks& a) {
  std::vector<float> inverse(3 * node_stride * a.rows.size(), 0.0F);
  for (int i = 0; i < static_cast<int>(a.rows.size()); ++i) {
    const Mat3 block = a.rows[i].back().block.inverse();
    for (int c = 0; c < 3; ++c) at(inverse, 3 * i + c) = block.col(c).cast<float>();
  }
  return inverse;
}

}  // namespace acus::numeric
