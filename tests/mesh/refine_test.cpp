#include "acus/mesh/refine.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <numbers>

#include "acus/mesh/quality.h"
#include "tests/mesh/mesh_checks.h"
#include "tests/mesh/random_mesh.h"

namespace acus::mesh {
namespace {

Vec3 random_point() {
  const auto coordinate = [] { return *rc::gen::inRange(-2000, 2001) / 1000.0; };
  const double x = coordinate(), y = coordinate(), z = coordinate();
  return {x, y, z};
}

double volume_of_region(const TetMesh& mesh, int region) {
  double sum = 0.0;
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    if (mesh.region[t] == region) sum += signed_volume(mesh, mesh.tets[t]);
  }
  return sum;
}

double longest_edge(const TetMesh& mesh, const Tet& tet) {
  return quality(TetMesh{mesh.nodes, {tet}, {0}}).longest_edge;
}

RC_GTEST_PROP(RefinedMesh, is_conforming_and_keeps_volume_surface_and_regions, ()) {
  const TetMesh coarse = random_mesh();
  const Vec3 from = random_point(), to = random_point();
  const double near = *rc::gen::inRange(5, 100) / 100.0, grading = *rc::gen::inRange(0, 150) / 100.0;
  const TetMesh fine = refined_along_path(coarse, from, to, near, grading, 8000);
  RC_ASSERT(fine.tets.size() <= 8000U);
  RC_ASSERT(fine.region.size() == fine.tets.size());
  RC_ASSERT(smallest_volume(fine) > 0.0);
  RC_ASSERT(most_tets_on_a_face(fine) <= 2);
  RC_ASSERT(euler_characteristic(fine) == 1);
  RC_ASSERT(std::abs(total_volume(fine) / total_volume(coarse) - 1.0) < 1e-12);
  RC_ASSERT(std::abs(free_face_area(fine) / free_face_area(coarse) - 1.0) < 1e-12);
  for (int r : {0, 1}) {
    RC_ASSERT(std::abs(volume_of_region(fine, r) - volume_of_region(coarse, r)) <
              1e-12 * total_volume(coarse));
  }
  RC_ASSERT(std::equal(coarse.nodes.begin(), coarse.nodes.end(), fine.nodes.begin()));
}

RC_GTEST_PROP(RefinedMesh, keeps_at_least_a_third_of_the_smallest_angle, ()) {
  const TetMesh coarse = random_mesh();
  const TetMesh fine = refined_along_path(coarse, random_point(), random_point(), 0.02, 0.3, 8000);
  RC_ASSERT(quality(fine).smallest_dihedral_angle > quality(coarse).smallest_dihedral_angle / 3.0);
}

RC_GTEST_PROP(RefinedMesh, has_the_edges_asked_for_where_the_count_allows, ()) {
  const TetMesh coarse = random_mesh();
  const Vec3 from = random_point(), to = random_point();
  const TetMesh fine = refined_along_path(coarse, from, to, 0.3, 0.5, 1000000);
  for (const Tet& tet : fine.tets) {
    const double length = longest_edge(fine, tet);
    for (int n : tet) {
      RC_ASSERT(length <= 0.3 + 0.5 * distance_to_segment(fine.nodes[static_cast<std::size_t>(n)], from, to));
    }
  }
}

TEST(RefinedMesh, stays_as_it_is_when_fine_enough) {
  const TetMesh coarse = build_block({1.0, 1.0, 1.0}, {2, 2, 2});
  const TetMesh same = refined_along_path(coarse, {0, 0, 0}, {0, 0, 1}, 1.0, 0.0, 1000);
  EXPECT_EQ(same.tets, coarse.tets);
  EXPECT_EQ(same.nodes, coarse.nodes);
}

TEST(RefinedMesh, ends_even_if_no_edge_is_ever_short_enough) {
  const TetMesh coarse = build_block({1.0, 1.0, 1.0}, {1, 1, 1});
  const TetMesh by_count = refined_along_path(coarse, {0, 0, 1}, {0, 0, 0}, 1e-300, 0.3, 5000);
  EXPECT_LE(by_count.tets.size(), 5000U);
  EXPECT_GT(by_count.tets.size(), 4500U);
  // Towards one point the count stays small, and the shortest allowed edge ends it.
  const TetMesh by_edge = refined_along_path(coarse, {0, 0, 1}, {0, 0, 1}, 1e-300, 1.0, 1000000);
  EXPECT_LT(by_edge.tets.size(), 100000U);
  EXPECT_GT(quality(by_edge).shortest_edge, 1e-7);
  EXPECT_GT(smallest_volume(by_edge), 0.0);
}

TEST(RefinedMesh, of_kuhn_cubes_has_only_the_three_shapes_of_maubach) {
  const TetMesh fine = refined(
      build_block({1, 1, 1}, {2, 2, 2}), [](const Vec3& x) { return 0.05 + 0.3 * x.norm(); }, 100000);
  // Edges over the longest: a Kuhn tetrahedron, its half and its quarter (Maubach 1995, SIAM J. Sci. Comput.
  // 16).
  const double r2 = std::sqrt(2.0), r3 = std::sqrt(3.0);
  const std::array<std::array<double, 6>, 3> shapes = {
      {{1 / r3, 1 / r3, 1 / r3, r2 / r3, r2 / r3, 1},
       {r3 / 2 / r2, r3 / 2 / r2, r3 / 2 / r2, 1 / r2, 1 / r2, 1},
       {0.5, 1 / r2, 1 / r2, r3 / 2, r3 / 2, 1}}};
  for (const Tet& tet : fine.tets) {
    std::array<double, 6> edges{};
    std::transform(tet_edges.begin(), tet_edges.end(), edges.begin(), [&](const auto& e) {
      return (fine.nodes[static_cast<std::size_t>(tet[e[0]])] -
              fine.nodes[static_cast<std::size_t>(tet[e[1]])])
          .norm();
    });
    std::sort(edges.begin(), edges.end());
    const bool known = std::any_of(shapes.begin(), shapes.end(), [&](const auto& shape) {
      return std::equal(edges.begin(), edges.end(), shape.begin(),
                        [&](double e, double s) { return std::abs(e / edges[5] - s) < 1e-12; });
    });
    EXPECT_TRUE(known) << edges[0] / edges[5] << ' ' << edges[1] / edges[5] << ' ' << edges[2] / edges[5]
                       << ' ' << edges[3] / edges[5] << ' ' << edges[4] / edges[5];
    if (!known) break;
  }
}

TEST(DistanceToSegment, counts_from_the_ends_beyond_them) {
  EXPECT_DOUBLE_EQ(distance_to_segment({0, 3, 0.5}, {0, 0, 0}, {0, 0, 1}), 3.0);
  EXPECT_DOUBLE_EQ(distance_to_segment({0, 3, 5}, {0, 0, 0}, {0, 0, 1}), 5.0);
  EXPECT_DOUBLE_EQ(distance_to_segment({3, 4, 0}, {0, 0, 0}, {0, 0, 0}), 5.0);
}

}  // namespace
}  // namespace acus::mesh
