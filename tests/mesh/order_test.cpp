#include "acus/mesh/order.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <set>

#include "tests/mesh/mesh_checks.h"
#include "tests/mesh/random_mesh.h"

namespace acus::mesh {
namespace {

// A mesh without its numbering: the corners of each tetrahedron in their order, and its region.
using Unnumbered = std::multiset<std::pair<std::array<std::array<double, 3>, 4>, int>>;
Unnumbered unnumbered(const TetMesh& mesh) {
  Unnumbered all;
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    std::array<std::array<double, 3>, 4> corners;
    for (std::size_t i = 0; i < 4; ++i) {
      const Vec3& x = mesh.nodes[static_cast<std::size_t>(mesh.tets[t][i])];
      corners[i] = {x.x(), x.y(), x.z()};
    }
    all.insert({corners, mesh.region[t]});
  }
  return all;
}

RC_GTEST_PROP(OrderForLocality, changes_nothing_but_the_numbers, ()) {
  const TetMesh mesh = random_mesh();
  RC_ASSERT(unnumbered(ordered_for_locality(mesh)) == unnumbered(mesh));
}

TEST(OrderForLocality, narrows_the_band_of_a_shuffled_mesh_to_a_quarter) {
  const TetMesh mixed = shuffled(*build_graded_block({0.1, 0.1, 0.06}, 10000), 1);
  const NodeSpread before = node_spread(mixed);
  const NodeSpread after = node_spread(ordered_for_locality(mixed));
  RecordProperty("largest_before", before.largest);
  RecordProperty("largest_after", after.largest);
  EXPECT_LT(4 * after.largest, before.largest);
  EXPECT_LT(4 * after.mean, before.mean);
}

TEST(OrderForLocality, numbers_a_chain_of_cells_along_the_chain) {
  // A bar one cell thick: a front across it has four nodes, so no better half bandwidth than a few fronts
  // exists.
  const TetMesh bar = shuffled(build_block({1, 1, 50}, {1, 1, 50}), 7);
  EXPECT_LE(node_spread(ordered_for_locality(bar)).largest, 8);
}

TEST(OrderForLocality, gives_the_same_order_every_time) {
  const TetMesh mixed = shuffled(*build_graded_block({0.1, 0.1, 0.06}, 3000), 2);
  const TetMesh once = ordered_for_locality(mixed), again = ordered_for_locality(mixed);
  EXPECT_EQ(once.tets, again.tets);
  EXPECT_EQ(once.nodes, again.nodes);
}

}  // namespace
}  // namespace acus::mesh
