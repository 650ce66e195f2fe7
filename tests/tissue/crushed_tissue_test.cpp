// Elements turned inside out, flattened and collapsed.
#include <gtest/gtest.h>

#include "acus/numeric/polar.h"
#include "tests/random_gradient.h"
#include "tests/tissue/irregular_block.h"
#include "tests/tissue/tissue_driver.h"

namespace acus::tissue {
namespace {

class CrushedTissue : public BothElements {};
ACUS_FOR_BOTH_ELEMENTS(CrushedTissue);

double farthest_from_rest(const BareTissue& tissue) {
  double farthest = 0.0;
  for (std::size_t i = 0; i < tissue.rest.size(); ++i) {
    const double distance = (tissue.position[i] - tissue.rest[i]).norm();
    if (!(distance <= farthest)) farthest = distance;  // takes over what is not a number, too
  }
  return farthest;
}

// Rotations follow elements that become flat, but not those of which less is left.
enum class Needs { nothing, safe_rotations };

// Two seconds of damped motion from `position`, all of it finite.
void recover(BareTissue& tissue, Needs needs, const std::function<Vec3(const Vec3&)>& crush) {
  for (int i = 0; i < tissue.model.free_nodes; ++i) tissue.position[i] = crush(tissue.rest[i]);
  corotate_into(tissue.corotation, tissue.model, tissue.position);
  ASSERT_TRUE(tissue.corotation.finite);
  double flattest = 1.0;  // volume over that at rest
  for (const mesh::Tet& t : tissue.model.corners) {
    const auto volume = [&](const std::vector<Vec3>& x) {
      return (x[t[1]] - x[t[0]]).cross(x[t[2]] - x[t[0]]).dot(x[t[3]] - x[t[0]]);
    };
    flattest = std::min(flattest, volume(tissue.position) / volume(tissue.rest));
  }
  ASSERT_LT(flattest, 1e-9);  // elements are crushed
  if (needs == Needs::safe_rotations) {
    ASSERT_GT(tissue.corotation.safe_rotations, 0);
  }
  tissue.relative_residual = 1e-8;
  const Rayleigh damping = {1.0, 2e-2};
  for (int step = 0; step < 200; ++step) {
    tissue.step(1e-2, damping);
    ASSERT_TRUE(tissue.corotation.finite);
  }
  EXPECT_LT(farthest_from_rest(tissue), 1e-6 * 0.03);
  EXPECT_EQ(tissue.corotation.safe_rotations, 0);
}

TEST_P(CrushedTissue, springs_back_from_a_plane) {
  BareTissue tissue(held_mesh(irregular_block(), at_bottom), soft, GetParam());
  recover(tissue, Needs::nothing, [](const Vec3& x) { return Vec3(x.x(), x.y(), 0.0); });
}

TEST_P(CrushedTissue, springs_back_from_a_line) {
  BareTissue tissue(held_mesh(irregular_block(), at_bottom), soft, GetParam());
  recover(tissue, Needs::safe_rotations, [](const Vec3& x) { return Vec3(0.0, 0.0, x.z()); });
}

TEST_P(CrushedTissue, springs_back_from_a_point) {
  BareTissue tissue(held_mesh(irregular_block(), at_bottom), soft, GetParam());
  recover(tissue, Needs::safe_rotations, [](const Vec3&) { return Vec3(0.0, 0.0, 0.01); });
}

TEST_P(CrushedTissue, springs_back_from_inside_out) {
  BareTissue tissue(held_mesh(irregular_block(), at_bottom), soft, GetParam());
  // The upper half pushed down through the lower one by half a box.
  recover(tissue, Needs::safe_rotations,
          [](const Vec3& x) { return Vec3(x.x(), x.y(), x.z() > 0.025 ? 0.005 : x.z()); });
}

TEST_P(CrushedTissue, says_when_a_position_is_not_a_number) {
  BareTissue tissue(held_mesh(irregular_block(), at_bottom), soft, GetParam());
  tissue.position[3].y() = std::nan("");
  corotate_into(tissue.corotation, tissue.model, tissue.position);
  EXPECT_FALSE(tissue.corotation.finite);
}

// The elements' kernel takes eight gradients at a time; each must come out as if it were alone.
TEST(ElementRotations, of_random_gradients_are_those_of_the_polar_decomposition) {
  constexpr int tets = 1003;  // not a multiple of eight
  mesh::TetMesh mesh;
  for (int e = 0; e < tets; ++e) {
    mesh.nodes.insert(mesh.nodes.end(), {Vec3::Zero(), Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ()});
    mesh.tets.push_back({4 * e, 4 * e + 1, 4 * e + 2, 4 * e + 3});
  }
  BareTissue tissue(held_mesh(mesh, nowhere), soft, ElementKind::linear);
  std::mt19937 random(11);
  std::vector<Mat3> F(tets);
  for (int done = 0; done < testing::gradient_count / 5; done += tets) {
    for (int e = 0; e < tets; ++e) {
      F[e] = testing::random_gradient(done + e, random);
      for (int i = 0; i < 4; ++i) tissue.position[4 * e + i] = F[e] * mesh.nodes[4 * e + i];
    }
    corotate_into(tissue.corotation, tissue.model, tissue.position);
    for (int e = 0; e < tets; ++e) {
      Mat3 R;  // its columns are R g_i with g_i the unit vectors
      for (int k = 0; k < 9; ++k)
        R.data()[k] = tissue.corotation.exact.gradient[place_of<double>(tissue.model.element[e], k, 9)];
      ASSERT_TRUE(R.allFinite());
      ASSERT_LT((R.transpose() * R - Mat3::Identity()).norm(), 1e-12) << F[e];
      ASSERT_NEAR(R.determinant(), 1.0, 1e-12) << F[e];
      const double reached = (R.transpose() * F[e]).trace();
      const double best = (numeric::rotation_of(F[e]).transpose() * F[e]).trace();
      ASSERT_NEAR(reached, best, 1e-12 * F[e].norm()) << F[e];
    }
  }
}

}  // namespace
}  // namespace acus::tissue
