// A loaded motion told in other words - nodes renumbered, the room turned or mirrored, other units - is the
// same motion.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <random>

#include "tests/tissue/irregular_block.h"
#include "tests/tissue/tissue_driver.h"

namespace acus::tissue {
namespace {

class Invariance : public BothElements {};
ACUS_FOR_BOTH_ELEMENTS(Invariance);

// A block held at its bottom and pushed aside at its top, hard enough to bend over.
struct Case {
  mesh::TetMesh mesh = irregular_block();
  std::vector<Material> materials = mixed_materials(mesh.tets.size());
  std::vector<bool> held;
  std::vector<Vec3> load;  // N
  double step = 2e-3;      // s
  Rayleigh damping = {2.0, 1e-3};

  Case() {
    for (const Vec3& x : mesh.nodes) {
      held.push_back(x.z() < 1e-9);
      load.push_back(x.z() > 0.03 - 1e-9 && x.y() > 0.0 ? Vec3(0.6, 0.2, -0.5) : Vec3::Zero());
    }
  }
};

// Positions after each tenth of 60 steps, in the case's own numbering of nodes.
std::vector<std::vector<Vec3>> history(const Case& c, ElementKind kind) {
  std::vector<int> new_index(c.held.size());
  int next = 0;
  for (bool held : {false, true})
    for (std::size_t i = 0; i < c.held.size(); ++i)
      if (c.held[i] == held) new_index[i] = next++;
  HeldMesh held{c.mesh, static_cast<int>(std::count(c.held.begin(), c.held.end(), false))};
  for (std::size_t i = 0; i < c.held.size(); ++i) held.mesh.nodes[new_index[i]] = c.mesh.nodes[i];
  for (mesh::Tet& t : held.mesh.tets)
    for (int& node : t) node = new_index[node];
  BareTissue tissue(held, c.materials, kind);
  for (std::size_t i = 0; i < c.held.size(); ++i)
    if (!c.held[i]) numeric::at(tissue.load, new_index[i]) = c.load[i];
  std::vector<std::vector<Vec3>> frames;
  for (int step = 1; step <= 60; ++step) {
    tissue.step(c.step, c.damping);
    if (step % 6 != 0) continue;
    frames.emplace_back();
    for (int index : new_index) frames.back().push_back(tissue.position[index]);
  }
  return frames;
}

// Largest distance between the histories, told[i](frame, node) mapped back by `back`, in units of the block.
template <class Back>
double difference(const std::vector<std::vector<Vec3>>& told, const std::vector<std::vector<Vec3>>& original,
                  Back back) {
  double worst = 0.0, moved = 0.0;
  for (std::size_t f = 0; f < original.size(); ++f)
    for (std::size_t i = 0; i < original[f].size(); ++i) {
      worst = std::max(worst, (back(told[f], i) - original[f][i]).norm());
      moved = std::max(moved, (original[f][i] - original[0][i]).norm());
    }
  EXPECT_GT(moved, 5e-3);  // m: a large motion
  return worst / moved;
}

constexpr double same = 1e-9;

TEST_P(Invariance, to_the_numbering_of_nodes_and_elements) {
  const Case original;
  std::mt19937 random(2);
  std::vector<int> node(original.held.size());
  std::vector<std::size_t> element(original.mesh.tets.size());
  std::iota(node.begin(), node.end(), 0);
  std::iota(element.begin(), element.end(), 0U);
  std::shuffle(node.begin(), node.end(), random);
  std::shuffle(element.begin(), element.end(), random);
  Case told = original;
  for (std::size_t i = 0; i < node.size(); ++i) {
    told.mesh.nodes[node[i]] = original.mesh.nodes[i];
    told.held[node[i]] = original.held[i];
    told.load[node[i]] = original.load[i];
  }
  for (std::size_t e = 0; e < element.size(); ++e) {
    const mesh::Tet& t = original.mesh.tets[element[e]];
    // Corners in another order, too: an even permutation keeps the volume positive.
    told.mesh.tets[e] = {node[t[1]], node[t[2]], node[t[0]], node[t[3]]};
    told.materials[e] = original.materials[element[e]];
  }
  EXPECT_LT(difference(history(told, GetParam()), history(original, GetParam()),
                       [&](const std::vector<Vec3>& x, std::size_t i) { return x[node[i]]; }),
            same);
}

TEST_P(Invariance, to_the_direction_of_the_axes) {
  const Case original;
  const Mat3 turn = Eigen::AngleAxisd(2.3, Vec3(1.0, 2.0, -0.7).normalized()).toRotationMatrix();
  const Vec3 shift(0.2, -0.3, 0.1);
  Case told = original;
  for (Vec3& x : told.mesh.nodes) x = turn * x + shift;
  for (Vec3& f : told.load) f = turn * f;
  EXPECT_LT(difference(history(told, GetParam()), history(original, GetParam()),
                       [&](const std::vector<Vec3>& x, std::size_t i) {
                         return Vec3(turn.transpose() * (x[i] - shift));
                       }),
            same);
}

TEST_P(Invariance, to_a_mirror) {
  const Case original;
  const Mat3 mirror = Vec3(-1.0, 1.0, 1.0).asDiagonal();
  Case told = original;
  for (Vec3& x : told.mesh.nodes) x = mirror * x;
  for (Vec3& f : told.load) f = mirror * f;
  for (mesh::Tet& t : told.mesh.tets) std::swap(t[0], t[1]);  // keeps the volume positive
  EXPECT_LT(difference(history(told, GetParam()), history(original, GetParam()),
                       [&](const std::vector<Vec3>& x, std::size_t i) { return Vec3(mirror * x[i]); }),
            same);
}

TEST_P(Invariance, to_the_units_of_length_stress_and_mass) {
  const Case original;
  const double length = 1e3, stress = 7.0, density = 0.013;
  const double time = length * std::sqrt(density / stress), force = stress * length * length;
  Case told = original;
  for (Vec3& x : told.mesh.nodes) x *= length;
  for (Vec3& f : told.load) f *= force;
  for (Material& m : told.materials) m.youngs_modulus *= stress, m.density *= density;
  told.step *= time;
  told.damping = {original.damping.mass / time, original.damping.stiffness * time};
  EXPECT_LT(difference(history(told, GetParam()), history(original, GetParam()),
                       [&](const std::vector<Vec3>& x, std::size_t i) { return Vec3(x[i] / length); }),
            same);
}

}  // namespace
}  // namespace acus::tissue
