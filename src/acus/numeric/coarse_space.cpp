#include "acus/numeric/coarse_space.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "acus/numeric/pieces.h"
#include "acus/numeric/simd.h"

namespace acus::numeric {
namespace {

constexpr int most_planes = 5;  // across an axis: the grid's inverse must stay in the cache
constexpr int fewest_planes = 2;
constexpr double nodes_per_grid_node = 16.0;  // below this the grid costs more than it saves
constexpr int strip = 64;                     // columns of the inverse handled together
// Relative, on the diagonal: where few nodes lie, the grid's unknowns need not be independent.
constexpr double regularisation = 1e-4;

using Planes = std::vector<double>;

Planes planes_across(int axis, std::span<const Vec3> positions, int count) {
  std::vector<double> sorted;
  for (const Vec3& x : positions) sorted.push_back(x[axis]);
  std::sort(sorted.begin(), sorted.end());
  const double extent = sorted.back() - sorted.front();
  constexpr double closest = 1e-3;  // of the extent
  Planes planes{sorted.front()};
  for (int k = 1; k < count; ++k) {
    const double at = sorted[(sorted.size() - 1) * k / (count - 1)];
    if (at > planes.back() + closest * extent) planes.push_back(at);
  }
  if (planes.size() == 1) planes.push_back(planes.front() + 1.0);  // all in one plane: any second one does
  return planes;
}

// Kuhn's simplex of the box around a point: from the low corner along the axes by falling local coordinate.
void place(CoarseSpace& space, const std::array<Planes, 3>& planes, const Vec3& x) {
  const std::array<int, 3> step = {1, static_cast<int>(planes[0].size()),
                                   static_cast<int>(planes[0].size() * planes[1].size())};
  std::array<std::pair<double, int>, 3> local;  // coordinate in the box, step along its axis
  int corner = 0;
  for (int c = 0; c < 3; ++c) {
    const Planes& p = planes[c];
    const auto above = std::upper_bound(p.begin() + 1, p.end() - 1, x[c]);
    local[c] = {(x[c] - above[-1]) / (above[0] - above[-1]), step[c]};
    corner += static_cast<int>(above - p.begin() - 1) * step[c];
  }
  std::stable_sort(local.begin(), local.end(),
                   [](const auto& a, const auto& b) { return a.first > b.first; });
  std::array<int, 4> corners{corner};
  std::array<float, 4> weights{
      static_cast<float>(1.0 - local[0].first), static_cast<float>(local[0].first - local[1].first),
      static_cast<float>(local[1].first - local[2].first), static_cast<float>(local[2].first)};
  for (int i = 0; i < 3; ++i) corners[i + 1] = corner += local[i].second;
  for (int& c : corners) c *= node_stride;
  space.corner.push_back(corners);
  space.weight.push_back(weights);
}

// field = P^T r for r at a range of nodes, zero elsewhere
ACUS_KERNEL void restrict_range(NodeVectorOf<float>& field, const CoarseSpace& space,
                                const NodeVectorOf<float>& r, Range range) {
  std::fill(field.begin(), field.end(), 0.0F);
  float* to = field.data();
  const float* from = r.data();
  const std::array<int, 4>* corner = space.corner.data();
  const std::array<float, 4>* weight = space.weight.data();
  // Neighbours add to the same nodes of the grid and would wait for each other, so far-off nodes take turns.
  constexpr std::size_t streams = 8;
  const std::size_t share = (range.size() + streams - 1) / streams;
  for (std::size_t turn = range.first; turn < range.first + share; ++turn)
    for (std::size_t i = turn; i < range.last; i += share) {
      const Lane4f value = load4(from + node_stride * i);
      for (int k = 0; k < 4; ++k) {
        float* at = to + corner[i][k];
        store4(at, load4(at) + weight[i][k] * value);
      }
    }
}

// z += P field at a range of nodes
ACUS_KERNEL void add_interpolated(NodeVectorOf<float>& z, const CoarseSpace& space,
                                  const NodeVectorOf<float>& field, Range range) {
  float* to = z.data();
  const float* from = field.data();
  const std::array<int, 4>* corner = space.corner.data();
  const std::array<float, 4>* weight = space.weight.data();
  for (std::size_t i = range.first; i < range.last; ++i) {
    const Lane4f first =
        weight[i][0] * load4(from + corner[i][0]) + weight[i][1] * load4(from + corner[i][1]);
    const Lane4f last = weight[i][2] * load4(from + corner[i][2]) + weight[i][3] * load4(from + corner[i][3]);
    store4(to + node_stride * i, load4(to + node_stride * i) + (first + last));
  }
}

// One strip of the product of the inverse and the load.
template <class Lane>
ACUS_INLINE void add_columns(float* correction, const float* row, std::span<const float> load) {
  constexpr int in_lane = sizeof(Lane) / sizeof(float), lanes = strip / in_lane;
  Lane sum[lanes] = {};
  for (const float by : load) {
    ACUS_UNROLL
    for (int l = 0; l < lanes; ++l) sum[l] += by * load_lanes<Lane>(row + in_lane * l);
    row += strip;
  }
  std::memcpy(correction, sum, sizeof sum);
}
void correct_strip(CoarseScratch& s, const CoarseSpace& space, int number) {
  const std::size_t first = static_cast<std::size_t>(number) * strip;
  run_kernel([&](auto bytes) ACUS_INLINED {
    add_columns<LaneOf<float, bytes>>(&s.correction[first], &space.inverse[first * space.size], s.load);
  });
}

// Gauss and Jordan's inverse in place of a symmetric positive definite matrix of n rows.
ACUS_KERNEL void invert(std::vector<double>& a, int n) {
  for (int k = 0; k < n; ++k) {
    double* pivot_row = &a[static_cast<std::size_t>(k) * n];
    const double inverse = 1.0 / pivot_row[k];
    pivot_row[k] = 1.0;
    for (int j = 0; j < n; ++j) pivot_row[j] *= inverse;
    for (int i = 0; i < n; ++i) {
      if (i == k) continue;
      double* row = &a[static_cast<std::size_t>(i) * n];
      const double factor = row[k];
      row[k] = 0.0;
      for (int j = 0; j < n; ++j) row[j] -= factor * pivot_row[j];
    }
  }
}

// P^T A P
std::vector<double> grid_matrix(const CoarseSpace& space, const LowerBlocks& a) {
  const auto n = static_cast<std::size_t>(space.size);
  std::vector<double> matrix(n * n, 0.0);
  const auto add = [&](std::size_t i, std::size_t j, const Mat3& block) {
    for (int k = 0; k < 4; ++k)
      for (int l = 0; l < 4; ++l) {
        const double weight =
            static_cast<double>(space.weight[i][k]) * static_cast<double>(space.weight[j][l]);
        const std::size_t row = static_cast<std::size_t>(space.corner[i][k]) / node_stride * 3;
        const std::size_t column = static_cast<std::size_t>(space.corner[j][l]) / node_stride * 3;
        for (int r = 0; r < 3; ++r)
          for (int c = 0; c < 3; ++c) matrix[(row + r) * n + column + c] += weight * block(r, c);
      }
  };
  for (std::size_t i = 0; i < a.rows.size(); ++i)
    for (const LowerBlocks::Entry& e : a.rows[i]) {
      const auto j = static_cast<std::size_t>(e.column);
      add(i, j, e.block);
      if (j != i) add(j, i, e.block.transpose());
    }
  return matrix;
}

}  // namespace

CoarseSpace build_coarse_space(std::span<const Vec3> positions, const LowerBlocks& a) {
  CoarseSpace space;
  // The cube of which comes nearest to as many nodes as there should be.
  const double wanted = static_cast<double>(positions.size()) / nodes_per_grid_node;
  int count = fewest_planes;
  while (count < most_planes && (count + 0.5) * (count + 0.5) * (count + 0.5) <= wanted) ++count;
  std::array<Planes, 3> planes;
  for (int c = 0; c < 3; ++c) planes[c] = planes_across(c, positions, count);
  for (const Vec3& x : positions) place(space, planes, x);
  const int n = static_cast<int>(3 * planes[0].size() * planes[1].size() * planes[2].size());
  space.size = n;
  std::vector<double> matrix = grid_matrix(space, a);
  for (int i = 0; i < n; ++i) {
    double& diagonal = matrix[static_cast<std::size_t>(i) * n + i];
    diagonal = diagonal > 0.0 ? diagonal * (1.0 + regularisation) : 1.0;  // 1 where the grid holds no node
  }
  invert(matrix, n);
  const int strips = (n + strip - 1) / strip;
  space.inverse.assign(static_cast<std::size_t>(strips) * strip * n, 0.0F);
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const double mean =
          0.5 * (matrix[static_cast<std::size_t>(i) * n + j] + matrix[static_cast<std::size_t>(j) * n + i]);
      space.inverse[(static_cast<std::size_t>(j / strip) * n + i) * strip + j % strip] =
          static_cast<float>(mean);
    }
  return space;
}

CoarseScratch build_scratch(const CoarseSpace& space) {
  CoarseScratch s;
  const NodeVectorOf<float> field(static_cast<std::size_t>(space.size) / 3 * node_stride, 0.0F);
  s.field.assign(pieces_of(space.corner.size() * node_stride), field);
  s.load.assign(space.size, 0.0F);
  s.correction.assign((static_cast<std::size_t>(space.size) + strip - 1) / strip * strip, 0.0F);
  return s;
}

void add_coarse_correction_into(NodeVectorOf<float>& z, const CoarseSpace& space,
                                const NodeVectorOf<float>& r, CoarseScratch& s, const Team& team) {
  const std::size_t size = space.corner.size() * node_stride;
  const auto nodes_of = [&](int piece) {
    const Range numbers = piece_of(size, piece);
    return Range{numbers.first / node_stride, numbers.last / node_stride};
  };
  const int pieces = pieces_of(size);
  team.run(pieces, [&](int piece) { restrict_range(s.field[piece], space, r, nodes_of(piece)); });
  NodeVectorOf<float>& field = s.field.front();
  for (int piece = 1; piece < pieces; ++piece) add_scaled_into(field, 1.0, s.field[piece]);
  for (int i = 0; i < space.size / 3; ++i)
    for (int c = 0; c < 3; ++c) s.load[3 * i + c] = field[node_stride * i + c];
  const int strips = static_cast<int>(s.correction.size()) / strip;
  if (pieces == 1)  // not worth the handing out
    for (int k = 0; k < strips; ++k) correct_strip(s, space, k);
  else
    team.run(strips, [&](int k) { correct_strip(s, space, k); });
  for (int i = 0; i < space.size / 3; ++i)
    for (int c = 0; c < 3; ++c) field[node_stride * i + c] = s.correction[3 * i + c];
  team.run(pieces, [&](int piece) { add_interpolated(z, space, field, nodes_of(piece)); });
}

}  // namespace acus::numeric
