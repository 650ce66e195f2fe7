#include "acus/study/section.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace acus::study {
namespace {

// A block [0,2] x [0,1] x [0,1] of `n` cells a metre, each cut into Kuhn's six tetrahedra; inner nodes are
// moved about.
mesh::TetMesh crooked_block(int n) {
  mesh::TetMesh block;
  const int nx = 2 * n, ny = n, nz = n;
  const auto id = [&](int i, int j, int k) { return i + (nx + 1) * (j + (ny + 1) * k); };
  for (int k = 0; k <= nz; ++k) {
    for (int j = 0; j <= ny; ++j) {
      for (int i = 0; i <= nx; ++i) {
        const bool inner = i > 0 && i < nx && j > 0 && j < ny && k > 0 && k < nz;
        const double off = inner ? 0.13 * std::sin(7.0 * i + 3.0 * j + 5.0 * k) / n : 0.0;
        block.nodes.push_back(Vec3(i, j, k) / n + Vec3(off, -off, 0.7 * off));
      }
    }
  }
  for (int k = 0; k < nz; ++k) {
    for (int j = 0; j < ny; ++j) {
      for (int i = 0; i < nx; ++i) {
        std::array<int, 3> order{0, 1, 2};
        do {
          std::array<int, 3> at{i, j, k};
          mesh::Tet tet{id(i, j, k), 0, 0, 0};
          for (std::size_t s = 0; s < 3; ++s) {
            ++at[static_cast<std::size_t>(order[s])];
            tet[s + 1] = id(at[0], at[1], at[2]);
          }
          block.tets.push_back(tet);
        } while (std::next_permutation(order.begin(), order.end()));
      }
    }
  }
  return block;
}

double total_area(const Section& section) {
  double sum = 0.0;
  for (const CutPolygon& polygon : section.polygons) sum += area(polygon);
  return sum;
}

double outline_length(const Section& section) {
  double sum = 0.0;
  for (const auto& piece : section.outline)
    sum += std::hypot(piece[1][0] - piece[0][0], piece[1][1] - piece[0][1]);
  return sum;
}

TEST(Section, a_cut_across_a_block_has_the_area_and_outline_of_the_rectangle) {
  const mesh::TetMesh block = crooked_block(4);
  const CutPlane plane{{0.0, 0.37, 0.0}, Vec3::UnitX(), Vec3::UnitZ()};
  const Section section = cut_section(block.nodes, block.tets, plane);
  EXPECT_NEAR(total_area(section), 2.0, 1e-12);
  EXPECT_NEAR(outline_length(section), 6.0, 1e-12);
}

TEST(Section, a_slanting_cut_has_the_area_of_its_parallelogram) {
  const mesh::TetMesh block = crooked_block(4);
  // The plane z = 0.2 + 0.3 x crosses both ends and no top: 2 sqrt(1 + 0.09) long, 1 wide.
  const Vec3 along = Vec3(1.0, 0.0, 0.3).normalized();
  const Section section = cut_section(block.nodes, block.tets, {{0.0, 0.0, 0.2}, along, Vec3::UnitY()});
  EXPECT_NEAR(total_area(section), 2.0 * std::sqrt(1.09), 1e-12);
  EXPECT_NEAR(outline_length(section), 2.0 + 4.0 * std::sqrt(1.09), 1e-12);
}

TEST(Section, a_corner_cut_off_is_the_triangle_of_its_three_edges) {
  const mesh::TetMesh block = crooked_block(3);
  // x + y + z = 0.6: an equilateral triangle of side 0.6 sqrt(2).
  const Vec3 normal = Vec3(1.0, 1.0, 1.0).normalized();
  const Vec3 right = Vec3(1.0, -1.0, 0.0).normalized();
  const Section section = cut_section(block.nodes, block.tets, {{0.2, 0.2, 0.2}, right, normal.cross(right)});
  EXPECT_NEAR(total_area(section), std::numbers::sqrt3 / 4.0 * 0.72, 1e-12);
}

TEST(Section, a_plane_through_nodes_counts_every_face_once) {
  mesh::TetMesh block = crooked_block(4);
  for (Vec3& node : block.nodes)
    node = (4.0 * node).array().round().matrix() / 4.0;  // straight again: faces in the plane
  const Section section =
      cut_section(block.nodes, block.tets, {{0.0, 0.5, 0.0}, Vec3::UnitX(), Vec3::UnitZ()});
  EXPECT_NEAR(total_area(section), 2.0, 1e-12);
  EXPECT_NEAR(outline_length(section), 6.0, 1e-12);
}

TEST(Section, a_plane_beside_the_block_cuts_nothing) {
  const mesh::TetMesh block = crooked_block(2);
  EXPECT_TRUE(
      cut_section(block.nodes, block.tets, {{0.0, 1.5, 0.0}, Vec3::UnitX(), Vec3::UnitZ()}).polygons.empty());
}

TEST(Section, the_plane_of_a_needle_holds_its_bow) {
  const Vec3 entry(0.1, 0.2, 0.3), down(0.0, 0.0, -1.0);
  const std::vector<Vec3> line{entry + Vec3(0.0, 0.0, 0.2), entry + Vec3(-0.03, 0.04, 0.1), entry};
  const CutPlane plane = plane_of_needle(entry, down, line);
  const Point2 bow = on_plane(plane, line[1]);
  EXPECT_NEAR(bow[0], 0.05, 1e-12);
  EXPECT_NEAR(bow[1], 0.1, 1e-12);
  EXPECT_NEAR(plane.right.dot(plane.up), 0.0, 1e-12);
  const CutPlane straight = plane_of_needle(entry, down, std::vector<Vec3>{line[0], entry});
  EXPECT_NEAR(straight.right.norm(), 1.0, 1e-12);
}

}  // namespace
}  // namespace acus::study
