// Uniform pressure over a circle on the Table I block.
#include <gtest/gtest.h>

#include <numbers>

#include "acus/coupling/attachment.h"
#include "tests/tissue/irregular_block.h"
#include "tests/tissue/tissue_driver.h"

namespace acus::tissue {
namespace {

const Vec3 block_size(0.1, 0.1, 0.06);  // m, the default block
constexpr double radius = 5e-3;         // m

// An even load over the circle: many points, each standing for the same area, in the sunflower's order.
coupling::Attachment even_load(const mesh::Locator& locator, int free_nodes) {
  constexpr int points = 20'000;  // 0.06 mm apart: finer than any element here
  const double golden_angle = std::numbers::pi * (3.0 - std::sqrt(5.0));
  std::vector<double> weight(static_cast<std::size_t>(free_nodes), 0.0);
  for (int i = 0; i < points; ++i) {
    const double r = radius * std::sqrt((i + 0.5) / points), angle = i * golden_angle;
    const auto at = locator.locate(Vec3(r * std::cos(angle), r * std::sin(angle), block_size.z()));
    for (int c = 0; c < 4; ++c) weight[at->nodes[c]] += at->weights[c] / points;
  }
  coupling::Attachment load;
  for (int i = 0; i < free_nodes; ++i)
    if (weight[i] > 0.0) load.node.push_back(i), load.weight.push_back(weight[i]);
  return load;
}

// Mean sink of the circle per newton spread over it, m/N, for a small load.
double mean_sink(const mesh::TetMesh& mesh, double poisson_ratio, ElementKind kind) {
  const HeldMesh held = held_mesh(mesh, at_bottom);
  BareTissue tissue(held, {25e3, poisson_ratio, 1000.0}, kind);
  tissue.relative_residual = 1e-6;
  const coupling::Attachment disc = even_load(mesh::Locator(held.mesh), held.free_nodes);
  const Vec3 down(0.0, 0.0, -1.0);
  coupling::add_along(tissue.load, disc, 1.0, down);
  return coupling::along(disc, tissue.linear_answer(tissue.load), down);
}

mesh::TetMesh graded(int tets) { return mesh::build_graded_block(block_size, tets).value(); }

// What the layers converge to on this block. Meshes refined around the circle to edges of
// s (1 mm + d / 4) at the distance d from it give, in mm/N, by both elements:
//   s      tetrahedra   nu = 0.48: linear, nodal_pressure   nu = 0.3: linear, nodal_pressure
//   1.0      62 552        3.0252   3.0657                     3.6182   3.6471
//   0.7     170 392        3.0728   3.0935                     3.6591   3.6743
//   0.5     392 024        3.0947   3.1065                     3.6777   3.6869
// The last two extrapolated by s^2: 3.1175, 3.1201 and 3.6972, 3.6999: both elements go to the same limits.
// The half-space, 16 (1 - nu^2) / (3 pi^2 E a), has 3.327 and 3.933: the floor 60 mm below makes the block
// stiffer.
struct Limit {
  double poisson_ratio, sink;  // sink in m/N
};
constexpr Limit nearly_incompressible = {0.48, 3.12e-3};
constexpr Limit compressible = {0.3, 3.70e-3};

double half_space(double poisson_ratio) {
  return 16.0 * (1.0 - poisson_ratio * poisson_ratio) /
         (3.0 * std::numbers::pi * std::numbers::pi * 25e3 * radius);
}

// Shares of the limit that are missing.
double shortfall(const mesh::TetMesh& mesh, const Limit& limit, ElementKind kind) {
  return 1.0 - mean_sink(mesh, limit.poisson_ratio, kind) / limit.sink;
}

TEST(CircularPatch, limits_lie_a_little_below_the_half_space) {
  for (const Limit& limit : {nearly_incompressible, compressible}) {
    EXPECT_LT(limit.sink, half_space(limit.poisson_ratio));
    EXPECT_GT(limit.sink, 0.9 * half_space(limit.poisson_ratio));
  }
}

TEST(CircularPatch, nodal_pressure_is_within_15_per_cent_at_10k_and_its_error_falls) {
  double before = 1.0;
  for (int tets : {3000, 10000, 30000}) {
    const double missing = shortfall(graded(tets), nearly_incompressible, ElementKind::nodal_pressure);
    EXPECT_GT(missing, 0.0);
    EXPECT_LT(missing, 0.75 * before);
    if (tets == 10000) {
      EXPECT_LT(missing, 0.15);
    }
    before = missing;
  }
}

TEST(CircularPatch, linear_locks_where_nodal_pressure_does_not) {
  for (int tets : {3000, 10000, 30000}) {
    const mesh::TetMesh mesh = graded(tets);
    const double linear = shortfall(mesh, nearly_incompressible, ElementKind::linear);
    const double nodal = shortfall(mesh, nearly_incompressible, ElementKind::nodal_pressure);
    EXPECT_GT(linear, 1.25 * nodal) << tets;
  }
}

TEST(CircularPatch, elements_agree_in_compressible_tissue) {
  for (int tets : {3000, 10000, 30000}) {
    const mesh::TetMesh mesh = graded(tets);
    const double linear = mean_sink(mesh, 0.3, ElementKind::linear);
    const double nodal = mean_sink(mesh, 0.3, ElementKind::nodal_pressure);
    EXPECT_NEAR(linear / nodal, 1.0, 0.06) << tets;
  }
}

// Minimum of potential energy: a mesh whose shapes are a subset can only be too stiff.
TEST(CircularPatch, linear_never_sinks_deeper_than_the_limit) {
  for (const Limit& limit : {nearly_incompressible, compressible})
    for (const std::array<int, 3>& cells :
         {std::array{8, 8, 5}, std::array{14, 14, 8}, std::array{20, 20, 12}})
      EXPECT_GT(shortfall(mesh::build_block(block_size, cells), limit, ElementKind::linear), 0.0);
}

}  // namespace
}  // namespace acus::tissue
