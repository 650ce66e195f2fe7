#include "acus/mesh/locator.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "acus/mesh/block.h"

namespace acus::mesh {
namespace {

const Vec3 size(0.1, 0.1, 0.06);

Vec3 random_point(double reach) {
  const auto coordinate = [&] { return reach * (*rc::gen::inRange(-100000, 100001)) / 100000.0; };
  const double x = coordinate(), y = coordinate(), z = coordinate();
  return {x, y, z};
}

class LocatorInGradedBlock : public ::testing::Test {
 protected:
  TetMesh mesh = *build_graded_block(size, 2000);
  Locator locator{mesh};
};

RC_GTEST_FIXTURE_PROP(LocatorInGradedBlock, reproduces_a_linear_field_everywhere_inside, ()) {
  const Vec3 p = Vec3(0.0, 0.0, 0.03) + random_point(1.0).cwiseProduct(Vec3(0.05, 0.05, 0.03));
  const auto found = locator.locate(p);
  RC_ASSERT(found.has_value());
  RC_ASSERT(found->nodes == mesh.tets[static_cast<std::size_t>(found->tet)]);
  double sum = 0.0;
  for (double w : found->weights) {
    RC_ASSERT(w >= 0.0);
    sum += w;
  }
  RC_ASSERT(std::abs(sum - 1.0) < 1e-14);
  Mat3 gradient;
  gradient << 2, -1, 5, 0.5, 3, 1, -4, 2, 7;
  std::vector<Vec3> field;
  for (const Vec3& x : mesh.nodes) field.push_back(Vec3(1, 2, 3) + gradient * x);
  RC_ASSERT((interpolate(*found, field) - (Vec3(1, 2, 3) + gradient * p)).norm() < 1e-13);
}

RC_GTEST_FIXTURE_PROP(LocatorInGradedBlock, snaps_to_the_nearest_point_of_the_surface_and_no_farther, ()) {
  const Vec3 p = Vec3(0.0, 0.0, 0.03) + random_point(0.1);
  const Vec3 nearest = p.cwiseMax(Vec3(-0.05, -0.05, 0.0)).cwiseMin(Vec3(0.05, 0.05, 0.06));  // of a box
  const double distance = (p - nearest).norm();
  const auto found = locator.locate(p, 0.03);
  RC_ASSERT(found.has_value() == (distance <= 0.03));
  if (found) RC_ASSERT((interpolate(*found, mesh.nodes) - nearest).norm() < 1e-12);
}

RC_GTEST_FIXTURE_PROP(LocatorInGradedBlock, finds_the_node_a_search_of_all_nodes_finds, ()) {
  const Vec3 p = random_point(0.2);
  int nearest = 0;
  for (int i = 1; i < static_cast<int>(mesh.nodes.size()); ++i) {
    const auto d = [&](int n) { return (mesh.nodes[static_cast<std::size_t>(n)] - p).squaredNorm(); };
    if (d(i) < d(nearest)) nearest = i;
  }
  RC_ASSERT(locator.nearest_node(p) == nearest);
}

// Wherever it is told to look first, nowhere included.
RC_GTEST_FIXTURE_PROP(LocatorInGradedBlock, finds_the_same_wherever_it_looks_first, ()) {
  const Vec3 p = random_point(0.2);
  const auto plain = locator.locate(p, 0.01);
  const int first = *rc::gen::inRange(-1, static_cast<int>(mesh.tets.size()));
  for (const int hint : {first, plain ? plain->tet : -1}) {
    const auto hinted = locator.locate(p, 0.01, hint);
    RC_ASSERT(hinted.has_value() == plain.has_value());
    if (!plain) continue;
    RC_ASSERT(hinted->tet == plain->tet);
    RC_ASSERT(hinted->nodes == plain->nodes);
    RC_ASSERT(hinted->weights == plain->weights);
  }
}

TEST_F(LocatorInGradedBlock, finds_every_node_in_a_tetrahedron_that_has_it) {
  for (std::size_t n = 0; n < mesh.nodes.size(); ++n) {
    const auto found = locator.locate(mesh.nodes[n]);
    ASSERT_TRUE(found);
    EXPECT_LT((interpolate(*found, mesh.nodes) - mesh.nodes[n]).norm(), 1e-15);
    EXPECT_EQ(locator.nearest_node(mesh.nodes[n]), static_cast<int>(n));
  }
}

// A node, an edge or a face belongs to several; which of them is found must not hang on the order in which
// the tree has them. All numbers are exact here.
TEST(LocatorInEqualBoxes, finds_the_lowest_of_all_that_share_a_point) {
  const TetMesh mesh = build_block({4.0, 4.0, 4.0}, {4, 4, 4});
  const Locator locator(mesh);
  const int tets = static_cast<int>(mesh.tets.size());
  const std::array<std::size_t, 3> node = {0, 0, 0}, edge = {1, 2, 2}, face = {0, 1, 3},
                                   other_face = {3, 1, 2};
  for (const Tet& tet : mesh.tets)
    for (const auto& corners : {node, edge, face, other_face}) {
      const std::array<int, 3> shared = {tet[corners[0]], tet[corners[1]], tet[corners[2]]};
      const auto has_all = [&](const Tet& t) {
        return std::all_of(shared.begin(), shared.end(),
                           [&](int n) { return std::find(t.begin(), t.end(), n) != t.end(); });
      };
      const auto lowest = std::find_if(mesh.tets.begin(), mesh.tets.end(), has_all) - mesh.tets.begin();
      const Embedding middle = {.nodes = {shared[0], shared[1], shared[2]}, .weights = {0.5, 0.25, 0.25}};
      for (int first = -1; first < tets; first += 97) {
        const auto found = locator.locate(interpolate(middle, mesh.nodes), 0.1, first);
        ASSERT_TRUE(found);
        ASSERT_EQ(found->tet, lowest);
      }
    }
}

TEST_F(LocatorInGradedBlock, forgives_rounding_at_the_surface_only) {
  EXPECT_TRUE(locator.locate({0.05 + 1e-9, 0.0, 0.06 + 1e-9}));
  EXPECT_FALSE(locator.locate({0.0, 0.0, 0.06 + 1e-5}));
  EXPECT_FALSE(locator.locate({0.0, 0.0, -1.0}));
}

TEST_F(LocatorInGradedBlock, finds_nothing_at_a_point_that_is_not_finite) {
  EXPECT_FALSE(locator.locate({0.0, std::nan(""), 0.0}, 1.0));
  EXPECT_FALSE(locator.locate({0.0, 0.0, std::numeric_limits<double>::infinity()}, 1.0));
}

}  // namespace
}  // namespace acus::mesh
