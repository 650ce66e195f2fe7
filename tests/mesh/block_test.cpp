#include "acus/mesh/block.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <set>

#include "acus/mesh/quality.h"
#include "tests/mesh/mesh_checks.h"

namespace acus::mesh {
namespace {

const Vec3 table_1_block(0.1, 0.1, 0.06);
constexpr double degree = std::numbers::pi / 180.0;

TEST(Volume, of_a_corner_of_the_unit_cube_is_a_sixth_and_negative_when_inverted) {
  EXPECT_DOUBLE_EQ(signed_volume(Vec3::Zero(), Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ()), 1.0 / 6.0);
  EXPECT_DOUBLE_EQ(signed_volume(Vec3::Zero(), Vec3::UnitY(), Vec3::UnitX(), Vec3::UnitZ()), -1.0 / 6.0);
}

TEST(Quality, of_the_regular_tetrahedron_is_the_best_there_is) {
  const TetMesh regular{{{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}}, {{0, 1, 2, 3}}, {0}};
  EXPECT_NEAR(smallest_dihedral_angle(regular, regular.tets[0]), std::acos(1.0 / 3.0), 1e-14);
  EXPECT_NEAR(aspect_ratio(regular, regular.tets[0]), 1.0, 1e-14);
}

TEST(Quality, of_a_cube_corner_has_its_right_angles_and_the_54_7_degrees_of_its_slanted_face) {
  const TetMesh corner{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 1, 2, 3}}, {0}};
  EXPECT_NEAR(smallest_dihedral_angle(corner, corner.tets[0]), std::acos(1.0 / std::sqrt(3.0)), 1e-14);
  // Longest edge sqrt(2), smallest height 1/sqrt(3).
  EXPECT_NEAR(aspect_ratio(corner, corner.tets[0]), std::sqrt(6.0) * std::sqrt(2.0 / 3.0), 1e-14);
  EXPECT_DOUBLE_EQ(quality(corner).longest_edge, std::sqrt(2.0));
  EXPECT_DOUBLE_EQ(quality(corner).shortest_edge, 1.0);
}

void expect_whole_block(const TetMesh& mesh, const Vec3& size) {
  const double rounding = 1e-12 * size.prod();
  EXPECT_NEAR(total_volume(mesh), size.prod(), rounding);
  EXPECT_GT(smallest_volume(mesh), 0.0);
  EXPECT_EQ(most_tets_on_a_face(mesh), 2);
  EXPECT_EQ(euler_characteristic(mesh), 1);
  const double surface = 2.0 * (size.x() * size.y() + size.y() * size.z() + size.z() * size.x());
  EXPECT_NEAR(free_face_area(mesh), surface, 1e-12 * surface);
  EXPECT_EQ(mesh.region.size(), mesh.tets.size());
  const auto box = bounds(mesh);
  EXPECT_EQ(box.min(), Vec3(-0.5 * size.x(), -0.5 * size.y(), 0.0));
  EXPECT_EQ(box.max(), Vec3(0.5 * size.x(), 0.5 * size.y(), size.z()));
}

TEST(Block, fills_its_box_without_gaps_or_overlaps) {
  for (const std::array<int, 3> cells : {std::array{1, 1, 1}, {2, 2, 1}, {3, 2, 4}, {7, 7, 4}}) {
    const TetMesh mesh = build_block(table_1_block, cells);
    EXPECT_EQ(mesh.tets.size(), static_cast<std::size_t>(6 * cells[0] * cells[1] * cells[2]));
    expect_whole_block(mesh, table_1_block);
  }
}

using Corners = std::set<std::array<double, 3>>;
std::set<Corners> shape_of(const TetMesh& mesh, const std::array<int, 3>& axes, const Vec3& sign) {
  std::set<Corners> shape;
  for (const Tet& t : mesh.tets) {
    Corners corners;
    for (int n : t) {
      const Vec3& x = mesh.nodes[static_cast<std::size_t>(n)];
      corners.insert({sign[0] * x[axes[0]] + 0.0, sign[1] * x[axes[1]] + 0.0, sign[2] * x[axes[2]]});
    }
    shape.insert(corners);
  }
  return shape;
}

TEST(GradedBlock, is_its_own_mirror_image_to_the_last_bit) {
  for (int target : {300, 1000, 10000}) {
    const TetMesh mesh = *build_graded_block(table_1_block, target);
    const auto shape = shape_of(mesh, {0, 1, 2}, {1, 1, 1});
    EXPECT_TRUE(shape == shape_of(mesh, {0, 1, 2}, {-1, 1, 1})) << target;
    EXPECT_TRUE(shape == shape_of(mesh, {0, 1, 2}, {1, -1, 1})) << target;
    EXPECT_TRUE(shape == shape_of(mesh, {1, 0, 2}, {1, 1, 1}))
        << target << ": a square block has its diagonals too";
  }
}

TEST(GradedBlock, has_the_count_asked_for_and_fills_its_box) {
  for (int target : {300, 400, 500, 700, 1000, 2000, 3000, 5000, 10000, 20000, 40000, 200000}) {
    const TetMesh mesh = *build_graded_block(table_1_block, target);
    EXPECT_NEAR(static_cast<double>(mesh.tets.size()), target, 0.1 * target);
    if (target <= 20000) expect_whole_block(mesh, table_1_block);
  }
}

TEST(GradedBlock, keeps_its_tetrahedra_well_shaped_however_fine) {
  for (int target : {300, 3000, 10000, 200000}) {
    const Quality worst = quality(*build_graded_block(table_1_block, target));
    EXPECT_GT(worst.smallest_dihedral_angle, 39.0 * degree) << target;
    EXPECT_LT(worst.largest_aspect_ratio, 2.8) << target;
  }
}

// Mean edge length of the tetrahedra whose centre lies in a shell around the path.
double mean_edge(const TetMesh& mesh, double from_radius, double to_radius) {
  double sum = 0.0;
  int count = 0;
  for (const Tet& t : mesh.tets) {
    Vec3 centre = Vec3::Zero();
    for (int n : t) centre += 0.25 * mesh.nodes[static_cast<std::size_t>(n)];
    const double radius = centre.head<2>().norm();
    if (radius < from_radius || radius >= to_radius) continue;
    for (const auto& [i, j] : tet_edges) {
      sum += (mesh.nodes[static_cast<std::size_t>(t[i])] - mesh.nodes[static_cast<std::size_t>(t[j])]).norm();
      ++count;
    }
  }
  return sum / count;
}

TEST(GradedBlock, is_fine_along_the_path_and_coarse_away_from_it) {
  const TetMesh mesh = *build_graded_block(table_1_block, 10000);
  const double on_path = mean_edge(mesh, 0.0, 2e-3);
  EXPECT_LT(on_path, 3e-3);
  EXPECT_GT(mean_edge(mesh, 10e-3, 20e-3), 1.5 * on_path);
  EXPECT_GT(mean_edge(mesh, 40e-3, 1.0), 4.0 * on_path);
}

TEST(GradedBlock, takes_any_proportions) {
  for (const Vec3& size :
       {Vec3(0.2, 0.05, 0.01), Vec3(0.02, 0.02, 0.2), Vec3(1.0, 1.0, 1.0), Vec3(1e-3, 2e-3, 5e-3)}) {
    const auto mesh = build_graded_block(size, 8000);
    ASSERT_TRUE(mesh) << mesh.error().sentence;
    expect_whole_block(*mesh, size);
    EXPECT_NEAR(static_cast<double>(mesh->tets.size()), 8000, 800);
    EXPECT_GT(quality(*mesh).smallest_dihedral_angle, 25.0 * degree);
  }
}

TEST(GradedBlock, says_why_it_cannot_be_built) {
  const auto too_few = build_graded_block(table_1_block, 20);
  ASSERT_FALSE(too_few);
  EXPECT_NE(too_few.error().sentence.find("needs at least 24 tetrahedra"), std::string::npos)
      << too_few.error().sentence;
  EXPECT_FALSE(build_graded_block({1.0, 1.0, 1e-9}, 10000));
  EXPECT_FALSE(build_graded_block({1.0, -1.0, 1.0}, 10000));
  EXPECT_FALSE(build_graded_block({1.0, std::nan(""), 1.0}, 10000));
}

}  // namespace
}  // namespace acus::mesh
