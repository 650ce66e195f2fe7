#include "acus/mesh/block.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "acus/mesh/refine.h"

namespace acus::mesh {
namespace {

// Of the block's depth: the distance from the path over which the wanted edge doubles, and the depth below
// the entry over which it does.
constexpr double sideways_doubling = 0.06;
constexpr double downward_doubling = 0.5;
constexpr int tets_per_cell = 6;

// Kuhn's six tetrahedra: the paths along the edges of a box from its corner 0 to the opposite one, one axis
// at a time.
constexpr std::array<std::array<int, 3>, 6> axis_orders = {
    {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}}};

bool is_odd(int i) { return i % 2 != 0; }

}  // namespace

TetMesh build_block(const Vec3& size, const std::array<int, 3>& cells) {
  const int nx = cells[0], ny = cells[1], nz = cells[2];
  TetMesh mesh;
  // Written so that nodes at i and n - i are mirror images to the last bit.
  const auto centred = [](int i, int n, double width) {
    return 0.5 * width * (static_cast<double>(2 * i - n) / n);
  };
  for (int k = 0; k <= nz; ++k) {
    for (int j = 0; j <= ny; ++j) {
      for (int i = 0; i <= nx; ++i) {
        mesh.nodes.emplace_back(centred(i, nx, size.x()), centred(j, ny, size.y()),
                                size.z() * (static_cast<double>(k) / nz));
      }
    }
  }
  const auto node = [&](const std::array<int, 3>& p) { return p[0] + (nx + 1) * (p[1] + (ny + 1) * p[2]); };
  for (int cell = 0; cell < nx * ny * nz; ++cell) {
    const std::array<int, 3> low = {cell % nx, cell / nx % ny, cell / (nx * ny)};
    // Paths start at a corner that the neighbouring boxes share, so that faces between boxes match; the entry
    // is one.
    std::array<int, 3> start{}, step{};
    const std::array<int, 3> hub = {nx / 2, ny / 2, nz};
    for (std::size_t d = 0; d < 3; ++d) {
      const bool from_high = is_odd(low[d] - hub[d]);
      start[d] = low[d] + (from_high ? 1 : 0);
      step[d] = from_high ? -1 : 1;
    }
    for (std::size_t o = 0; o < axis_orders.size(); ++o) {
      std::array<int, 3> p = start;
      Tet tet{node(p), 0, 0, 0};
      for (std::size_t d = 0; d < 3; ++d) {
        const auto axis = static_cast<std::size_t>(axis_orders[o][d]);
        p[axis] += step[axis];
        tet[d + 1] = node(p);
      }
      const bool odd_order = o >= 3;
      if (odd_order != (step[0] * step[1] * step[2] < 0)) std::swap(tet[2], tet[3]);
      mesh.tets.push_back(tet);
    }
  }
  mesh.region.assign(mesh.tets.size(), 0);
  return mesh;
}

Result<TetMesh> build_graded_block(const Vec3& size, int target_tets) {
  if (!size.allFinite() || size.minCoeff() <= 0.0) {
    return Error{"the block's size must be three positive lengths"};
  }
  // Two cells across put nodes on the path; near-cubic cells keep the angles of their descendants wide.
  const double edge = std::min({0.5 * size.x(), 0.5 * size.y(), size.z()});
  const Vec3 cells(2.0 * std::round(0.5 * size.x() / edge), 2.0 * std::round(0.5 * size.y() / edge),
                   std::round(size.z() / edge));
  const double fewest = tets_per_cell * cells.prod();
  if (!(fewest <= target_tets)) {
    return Error{"a block of these proportions needs at least " + std::to_string(std::llround(fewest)) +
                 " tetrahedra, but only " + std::to_string(target_tets) + " are asked for"};
  }
  const TetMesh coarse = build_block(
      size, {static_cast<int>(cells.x()), static_cast<int>(cells.y()), static_cast<int>(cells.z())});
  // Only the proportions of this size field matter: it asks for far more than the target, which ends the
  // refinement.
  const double depth = size.z();
  const auto wanted = [&](const Vec3& x) {
    const double sideways = x.head<2>().norm() / (sideways_doubling * depth);
    const double downward = (depth - x.z()) / (downward_doubling * depth);
    return 1e-9 * depth * (1.0 + sideways + downward);
  };
  return refined(coarse, wanted, target_tets);
}

}  // namespace acus::mesh
