#include "acus/coupling/punch.h"

#include <gtest/gtest.h>

#include <cmath>

#include "acus/coupling/attachment.h"
#include "acus/mesh/block.h"

namespace acus::coupling {
namespace {

const Vec3 size(0.1, 0.1, 0.06);  // m
const Vec3 top(0.0, 0.0, 0.06), down(0.0, 0.0, -1.0);

double share_on(const mesh::TetMesh& mesh, double radius, const Vec3& at = top) {
  return missing_share(mesh, mesh::Locator(mesh), at, down, radius, fewest_rings);
}

TEST(Punch, cube_edge_is_the_edge_of_kuhns_cube) {
  const mesh::TetMesh block = mesh::build_block({0.03, 0.03, 0.03}, {3, 3, 3});
  for (const mesh::Tet& tet : block.tets) EXPECT_NEAR(cube_edge(tet, block.nodes), 0.01, 1e-12);
}

// Sinks in mm/N of discs on meshes of the default block, and those that they go to on meshes refined around
// the disc to edges of an eighth of its radius: nodal_pressure elements, Poisson's ratio 0.48. What is
// missing is that of a half-space of 16.635, 6.654 and 3.327 mm/N.
struct Sink {
  int tetrahedra;  // 0: uniform boxes of 12.5 mm
  double radius, on_mesh, limit, half_space;
};
constexpr Sink sinks[] = {{0, 1e-3, 2.2128, 16.063, 16.635},      {0, 2.5e-3, 1.9746, 6.3563, 6.654},
                          {0, 5e-3, 1.6204, 3.0822, 3.327},       {2000, 1e-3, 10.2143, 16.063, 16.635},
                          {2000, 2.5e-3, 5.0147, 6.3563, 6.654},  {2000, 5e-3, 2.5068, 3.0822, 3.327},
                          {12000, 1e-3, 13.0608, 16.063, 16.635}, {12000, 2.5e-3, 5.5888, 6.3563, 6.654},
                          {12000, 5e-3, 2.8864, 3.0822, 3.327},   {40000, 1e-3, 13.6836, 16.063, 16.635},
                          {40000, 2.5e-3, 6.0252, 6.3563, 6.654}, {40000, 5e-3, 2.9777, 3.0822, 3.327}};

TEST(Punch, is_what_meshes_sink_too_little) {
  for (const Sink& s : sinks) {
    const mesh::TetMesh mesh = s.tetrahedra == 0 ? mesh::build_block(size, {8, 8, 5})
                                                 : mesh::build_graded_block(size, s.tetrahedra).value();
    const double mended = s.on_mesh + share_on(mesh, s.radius) * s.half_space;
    EXPECT_NEAR(mended, s.limit, 0.1 * s.limit) << s.tetrahedra << ", radius " << s.radius;
  }
}

TEST(Punch, falls_with_the_square_of_the_elements_and_never_leaves_its_bounds) {
  const double radius = 20e-3;
  const double coarse = share_on(mesh::build_block(size, {16, 16, 10}), radius);
  const double fine = share_on(mesh::build_block(size, {32, 32, 20}), radius);
  EXPECT_NEAR(fine, 0.25 * coarse, 0.03 * coarse);
  EXPECT_LE(share_on(mesh::build_block(size, {2, 2, 1}), 1e-5), 1.0);
  EXPECT_GE(share_on(mesh::build_block(size, {2, 2, 1}), 1.0), 0.0);
}

}  // namespace
}  // namespace acus::coupling
