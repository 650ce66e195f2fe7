#include "acus/mesh/checked.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <limits>

#include "tests/mesh/mesh_checks.h"
#include "tests/mesh/random_mesh.h"

namespace acus::mesh {
namespace {

const TetMesh cube = build_block({1, 1, 1}, {1, 1, 1});

void expect_refused(const TetMesh& mesh, const std::string& words) {
  const auto result = checked(mesh);
  ASSERT_FALSE(result);
  EXPECT_NE(result.error().sentence.find(words), std::string::npos) << result.error().sentence;
}

RC_GTEST_PROP(CheckedMesh, turns_inverted_tetrahedra_round_and_keeps_the_rest, ()) {
  const TetMesh whole = random_mesh();
  TetMesh turned = whole;
  for (Tet& t : turned.tets) {
    if (*rc::gen::arbitrary<bool>()) std::swap(t[0], t[1]);
  }
  const auto mended = checked(turned);
  RC_ASSERT(mended.ok());
  RC_ASSERT(smallest_volume(*mended) > 0.0);
  RC_ASSERT(std::abs(total_volume(*mended) / total_volume(whole) - 1.0) < 1e-14);
  RC_ASSERT(mended->region == whole.region);
}

TEST(CheckedMesh, loses_the_nodes_that_no_tetrahedron_uses) {
  TetMesh mesh = cube;
  mesh.nodes.insert(mesh.nodes.begin() + 2, Vec3(9, 9, 9));
  mesh.nodes.push_back({7, 7, 7});
  for (Tet& t : mesh.tets) {
    for (int& n : t) n += n >= 2 ? 1 : 0;
  }
  const auto mended = checked(mesh);
  ASSERT_TRUE(mended);
  EXPECT_EQ(mended->nodes, cube.nodes);
  EXPECT_EQ(mended->tets, cube.tets);
}

TEST(CheckedMesh, may_have_unused_nodes_that_are_not_finite) {
  TetMesh mesh = cube;
  mesh.nodes.emplace_back(std::nan(""), 0, 0);
  EXPECT_TRUE(checked(mesh));
}

TEST(CheckedMesh, without_tetrahedra_or_regions_is_refused) {
  expect_refused({}, "no tetrahedra");
  TetMesh mesh = cube;
  mesh.region.pop_back();
  expect_refused(mesh, "6 tetrahedra, but 5 region numbers");
}

TEST(CheckedMesh, with_an_index_out_of_range_is_refused) {
  for (int wrong : {-1, 8, std::numeric_limits<int>::max(), std::numeric_limits<int>::min()}) {
    TetMesh mesh = cube;
    mesh.tets[3][2] = wrong;
    expect_refused(mesh, "tetrahedron 3 has a node with index " + std::to_string(wrong));
  }
}

TEST(CheckedMesh, with_a_node_twice_in_a_tetrahedron_is_refused) {
  TetMesh mesh = cube;
  mesh.tets[5][0] = mesh.tets[5][3];
  expect_refused(mesh, "tetrahedron 5 has the same node at two corners");
}

TEST(CheckedMesh, with_a_coordinate_that_is_not_finite_is_refused) {
  for (double wrong : {std::nan(""), std::numeric_limits<double>::infinity()}) {
    TetMesh mesh = cube;
    mesh.nodes[static_cast<std::size_t>(mesh.tets[0][1])].y() = wrong;
    expect_refused(mesh, "tetrahedron 0 has a node whose coordinates are not finite");
  }
}

TEST(CheckedMesh, with_a_flat_tetrahedron_is_refused) {
  expect_refused({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.3, 0.3, 1e-9}}, {{0, 1, 2, 3}}, {0}},
                 "tetrahedron 0 is flat");
  expect_refused({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 0}}, {{0, 1, 2, 3}}, {0}},
                 "tetrahedron 0 is flat");
  // Thin ones of real meshes pass.
  EXPECT_TRUE(checked({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.3, 0.3, 1e-4}}, {{0, 1, 2, 3}}, {0}}));
}

TEST(CheckedMesh, with_overlapping_tetrahedra_is_refused) {
  TetMesh mesh = cube;
  mesh.tets.push_back(mesh.tets[2]);
  mesh.region.push_back(0);
  expect_refused(mesh, "tetrahedron 6 overlaps tetrahedron 2");
}

TEST(CheckedMesh, in_pieces_is_refused_whether_they_are_apart_or_hinged) {
  TetMesh mesh = cube;
  for (const Vec3& x : cube.nodes) mesh.nodes.push_back(x + Vec3(3, 0, 0));
  for (const Tet& t : cube.tets) mesh.tets.push_back({t[0] + 8, t[1] + 8, t[2] + 8, t[3] + 8});
  mesh.region.resize(12);
  expect_refused(mesh, "tetrahedron 6 and 5 more share no face with the rest of the mesh");
  const TetMesh hinged{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {-1, 0, 0}, {0, -1, 0}},
                       {{0, 1, 2, 3}, {0, 4, 5, 3}},
                       {0, 0}};
  expect_refused(hinged, "tetrahedron 1 shares no face");
}

}  // namespace
}  // namespace acus::mesh
