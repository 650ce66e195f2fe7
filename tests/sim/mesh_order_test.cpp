// How a mesh is numbered is no business of the needle: neither of its forces nor of what a step costs.
#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "acus/mesh/block.h"
#include "acus/mesh/order.h"
#include "acus/sim/model.h"
#include "acus/sim/simulation.h"
#include "tests/mesh/shuffled.h"

namespace acus {
namespace {

Scene scene_of_given_mesh(int most_tetrahedra) {
  Scene scene;
  scene.tissue.mesh = "given";
  scene.tissue.tetrahedra = most_tetrahedra;
  scene.tissue.direction = Vec3(0.0, 0.0, -1.0);
  scene.tissue.target = Vec3(1e-3, 2e-3, 20e-3);  // m, through no edge
  return scene;
}

// A block without equals: no two edges have one length, so that refinement has no choice.
mesh::TetMesh uneven_block() {
  mesh::TetMesh mesh = mesh::build_block({0.1, 0.1, 0.06}, {5, 5, 4});
  std::mt19937 random(11);
  std::uniform_real_distribution<double> shift(-2e-3, 2e-3);  // m, of 20
  for (Vec3& x : mesh.nodes) x += Vec3(shift(random), shift(random), shift(random));
  return mesh;
}

std::vector<double> forces(const mesh::TetMesh& mesh, NeedleModel model) {
  Scene scene = scene_of_given_mesh(1500);
  scene.needle_model = model;
  scene.contact.rupture_force = 0.1;        // N
  scene.contact.fracture_toughness = 20.0;  // J/m^2
  scene.run.solver_tolerance = 1e-10;
  auto simulation = Simulation::build(scene, &mesh);
  EXPECT_TRUE(simulation.ok()) << simulation.error().sentence;
  std::vector<double> felt;
  constexpr double stride = 0.1e-3;  // m
  for (int step = 1; step <= 60; ++step) felt.push_back(simulation->step(step * stride).hand_force);
  EXPECT_EQ(simulation->frame().stage, Stage::inserted);
  return felt;
}

class MeshOrder : public ::testing::TestWithParam<NeedleModel> {};
INSTANTIATE_TEST_SUITE_P(, MeshOrder, ::testing::Values(NeedleModel::rod, NeedleModel::column));

TEST_P(MeshOrder, does_not_change_what_a_hand_feels) {
  const mesh::TetMesh block = uneven_block();
  const std::vector<double> one = forces(block, GetParam());
  const std::vector<double> other = forces(mesh::shuffled(block, 5), GetParam());
  constexpr double rounding = 1e-9;  // N, of 0.2; the solver goes to 1e-10
  for (std::size_t i = 0; i < one.size(); ++i) EXPECT_NEAR(other[i], one[i], rounding) << "step " << i + 1;
}

// From one pair of elements to the one that the same lane takes next, m, on the average; and the spread of
// the nodes.
struct Locality {
  double stride = 0.0, spread = 0.0;
};
Locality locality(const Model& m) {
  const auto centre = [&](std::size_t pair) {
    Vec3 sum = Vec3::Zero();
    for (int node : m.tissue.corners[tissue::element_of_pair(pair, 0)]) sum += m.mesh.nodes[node];
    return Vec3(sum / 4.0);
  };
  Locality found;
  const std::size_t lanes = tissue::batch_pairs, strides = m.tissue.corners.size() / 2 - lanes;
  for (std::size_t pair = 0; pair < strides; ++pair)
    found.stride += (centre(pair + lanes) - centre(pair)).norm() / static_cast<double>(strides);
  found.spread = mesh::node_spread(m.mesh).mean;
  return found;
}

TEST(MeshLocality, of_a_shuffled_file_becomes_as_local_as_that_of_a_block) {
  constexpr int tetrahedra = 10000;
  const Scene scene = scene_of_given_mesh(tetrahedra);
  const Locality block = locality(*build_model(Scene{}, nullptr));
  const mesh::TetMesh mixed = mesh::shuffled(*mesh::build_graded_block(scene.tissue.size, tetrahedra), 1);
  const Locality given = locality(*build_model(scene, &mixed));
  EXPECT_LT(given.stride, 1.1 * block.stride);
  EXPECT_LT(given.spread, 1.1 * block.spread);
}

}  // namespace
}  // namespace acus
