// A second level for the preconditioner: smooth fields on a coarse grid laid over the nodes.
//
// Jacobi's preconditioner mends each node by itself and passes news on by one neighbour an iteration. What is
// smooth it mends slowly; here that part is solved at once on a grid of few nodes,
//   z = D^-1 r + P (P^T A P)^-1 P^T r   (additive two-level; Smith, Bjorstad and Gropp 1996),
// with P the interpolation from the grid. A enters only through a matrix that is near
// it and stays, such as the one at rest: z remains a symmetric positive definite function of r, which is all
// that conjugate gradients ask.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "acus/numeric/lower_blocks.h"
#include "acus/numeric/node_vector.h"

namespace acus::numeric {

struct CoarseSpace {
  int size = 0;                              // 3 x nodes of the grid
  std::vector<std::array<int, 4>> corner;    // [nodes] of the grid simplex a node lies in, x node_stride
  std::vector<std::array<float, 4>> weight;  // [nodes] its barycentric coordinates there
  std::vector<float> inverse;                // (P^T A P)^-1, in strips of columns; see the source
};
struct CoarseScratch {
  // [pieces of the nodes] one padded vector per node of the grid; the first is that of the whole
  std::vector<NodeVectorOf<float>> field;
  std::vector<float> load, correction;  // the same without padding
};

// The grid has planes across each axis at equal shares of the nodes, so that it is fine where they are.
// `a` is symmetric positive definite, a row for each of the positions.
CoarseSpace build_coarse_space(std::span<const Vec3> positions, const LowerBlocks& a);
CoarseScratch build_scratch(const CoarseSpace& space);

// z += P (P^T A P)^-1 P^T r
void add_coarse_correction_into(NodeVectorOf<float>& z, const CoarseSpace& space,
                                const NodeVectorOf<float>& r, CoarseScratch& scratch,
                                const Team& team = one_thread);

}  // namespace acus::numeric
