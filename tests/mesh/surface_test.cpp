#include "acus/mesh/surface.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

#include "acus/mesh/path.h"
#include "tests/mesh/mesh_checks.h"
#include "tests/mesh/random_mesh.h"

namespace acus::mesh {
namespace {

// Volume inside the triangles by the divergence theorem: only right if all normals point outwards.
double enclosed_volume(const TetMesh& mesh, const std::vector<Triangle>& triangles) {
  double volume = 0.0;
  for (const auto& [a, b, c] : triangles) {
    const auto x = [&](int n) { return mesh.nodes[static_cast<std::size_t>(n)]; };
    volume += x(a).dot(x(b).cross(x(c))) / 6.0;
  }
  return volume;
}

RC_GTEST_PROP(Surface, closes_and_encloses_the_volume_of_the_mesh, ()) {
  const TetMesh mesh = random_mesh();
  const auto triangles = boundary_triangles(mesh);
  RC_ASSERT(is_watertight(triangles));
  RC_ASSERT(std::abs(enclosed_volume(mesh, triangles) / total_volume(mesh) - 1.0) < 1e-13);
}

TEST(Surface, of_a_block_has_two_triangles_for_each_outer_square) {
  EXPECT_EQ(boundary_triangles(build_block({1, 1, 1}, {3, 4, 5})).size(), 4U * (3 * 4 + 4 * 5 + 5 * 3));
}

TEST(Surface, does_not_close_with_a_hole_or_a_turned_triangle) {
  auto triangles = boundary_triangles(build_block({1, 1, 1}, {2, 2, 2}));
  std::swap(triangles[3][0], triangles[3][1]);
  EXPECT_FALSE(is_watertight(triangles));
  triangles.erase(triangles.begin() + 3);
  EXPECT_FALSE(is_watertight(triangles));
}

TEST(Path, straight_down_through_a_node_at_the_centre_of_the_top_is_as_long_as_the_block_is_deep) {
  const auto path = find_path(*build_graded_block({0.1, 0.1, 0.06}, 2000), {0, 0, 0.01}, {0, 0, -2});
  ASSERT_TRUE(path) << path.error().sentence;
  EXPECT_LT((path->entry - Vec3(0, 0, 0.06)).norm(), 1e-15);
  EXPECT_EQ(path->direction, Vec3(0, 0, -1));
  EXPECT_NEAR(path->length, 0.06, 1e-15);
}

TEST(Path, from_any_side_meets_the_box_where_its_planes_say) {
  const TetMesh mesh = build_block({2, 2, 2}, {3, 4, 5});
  rc::check([&] {
    const auto number = [](int least, int most) { return *rc::gen::inRange(least, most) / 1000.0; };
    const Vec3 target(number(-900, 900), number(-900, 900), number(100, 1900));
    const Vec3 direction(number(-1000, 1000), number(-1000, 1000), number(-1000, 1000));
    RC_PRE(direction.norm() > 0.1 && direction.cwiseAbs().minCoeff() > 1e-3);
    const Vec3 along = direction.normalized();
    // Distances along the line to the two planes of each axis.
    const Vec3 low = (Vec3(-1, -1, 0) - target).cwiseQuotient(along),
               high = (Vec3(1, 1, 2) - target).cwiseQuotient(along);
    const double in = low.cwiseMin(high).maxCoeff(), out = low.cwiseMax(high).minCoeff();
    const auto path = find_path(mesh, target, direction);
    RC_ASSERT(path.ok());
    RC_ASSERT((path->entry - (target + in * along)).norm() < 1e-12);
    RC_ASSERT(std::abs(path->length - (out - in)) < 1e-12);
  });
}

// Two boxes with a gap, joined by a base: a needle along x passes into the first, out into the gap, and so
// on.
TEST(Path, ends_at_the_first_exit) {
  TetMesh mesh = build_block({3, 1, 2}, {3, 1, 2});
  const auto in_gap = [&](const Tet& t) {
    Vec3 centre = Vec3::Zero();
    for (int n : t) centre += 0.25 * mesh.nodes[static_cast<std::size_t>(n)];
    return std::abs(centre.x()) < 0.5 && centre.z() > 1.0;
  };
  std::erase_if(mesh.tets, in_gap);
  mesh.region.resize(mesh.tets.size());
  const auto path = find_path(mesh, {1.2, 0.1, 1.3}, {1, 0, 0});
  ASSERT_TRUE(path);
  EXPECT_NEAR(path->entry.x(), -1.5, 1e-14);
  EXPECT_NEAR(path->length, 1.0, 1e-14);
}

TEST(Path, along_the_outside_of_a_face_or_past_the_mesh_is_refused) {
  const TetMesh mesh = build_block({2, 2, 2}, {2, 2, 2});
  for (const Vec3& target : {Vec3(5, 0, 0), Vec3(1.0 + 1e-6, 0, 0)}) {
    const auto path = find_path(mesh, target, {0, 0, -1});
    ASSERT_FALSE(path);
    EXPECT_NE(path.error().sentence.find("misses the mesh, which fills (-1, -1, 0) to (1, 1, 2) m"),
              std::string::npos)
        << path.error().sentence;
  }
  EXPECT_FALSE(find_path(mesh, {0, 0, 0}, {0, 0, 0}));
  EXPECT_FALSE(find_path(mesh, {0, std::nan(""), 0}, {0, 0, 1}));
}

}  // namespace
}  // namespace acus::mesh
