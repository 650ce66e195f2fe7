// Blocks of tissue: sides along the axes, centred on x = y = 0, bottom at z = 0; entry at the centre of the
// top.
#pragma once

#include <array>

#include "acus/base/result.h"
#include "acus/mesh/tet_mesh.h"

namespace acus::mesh {

// cells[0] x cells[1] x cells[2] equal boxes of six tetrahedra each (Kuhn's subdivision, mirrored from box to
// box so that an even number of cells is symmetric about x = 0 and y = 0). `size` [m] and `cells` positive.
TetMesh build_block(const Vec3& size, const std::array<int, 3>& cells);

// A block refined in advance along the insertion path, the axis x = y = 0 (the paper's Fig. 8): finest at the
// entry, coarser with depth and with the distance from the path. The same on every machine, mirror-symmetric
// about x = 0 and y = 0. The count is at most `target_tets`, and within 10 % of it from 300 on. Error: a size
// that is not positive and finite, or a target that the coarsest mesh of near-cubic cells already exceeds.
Result<TetMesh> build_graded_block(const Vec3& size, int target_tets);

}  // namespace acus::mesh
