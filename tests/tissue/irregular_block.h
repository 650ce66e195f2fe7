// Meshes without symmetry, and tissue of two materials in them.
#pragma once

#include <random>

#include "acus/mesh/block.h"
#include "acus/tissue/material.h"

namespace acus::tissue {

// A block of 3 x 4 x 3 boxes (216 tetrahedra), 30 x 40 x 30 mm, bottom at z = 0, whose inner nodes are moved
// by up to `share` of a box.
inline mesh::TetMesh irregular_block(double share = 0.25, unsigned seed = 1) {
  const Vec3 size(0.03, 0.04, 0.03);
  mesh::TetMesh mesh = mesh::build_block(size, {3, 4, 3});
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> shift(-share * 0.01, share * 0.01);
  const auto inner = [](double x, double low, double high) { return x > low + 1e-9 && x < high - 1e-9; };
  for (Vec3& x : mesh.nodes)
    if (inner(x.x(), -0.015, 0.015) && inner(x.y(), -0.02, 0.02) && inner(x.z(), 0.0, 0.03))
      x += Vec3(shift(random), shift(random), shift(random));
  return mesh;
}

inline constexpr Material soft = {25e3, 0.48, 1000.0};
inline constexpr Material firm = {80e3, 0.3, 1200.0};

// Soft and firm tetrahedra at random.
inline std::vector<Material> mixed_materials(std::size_t tets, unsigned seed = 5) {
  std::mt19937 random(seed);
  std::vector<Material> materials;
  for (std::size_t e = 0; e < tets; ++e) materials.push_back(random() % 2 ? soft : firm);
  return materials;
}

// Every node moved at random by a normal deviate of `spread` [m] a component.
inline std::vector<Vec3> jolted(std::vector<Vec3> nodes, double spread, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> shift(0.0, spread);
  for (Vec3& x : nodes) x += Vec3(shift(random), shift(random), shift(random));
  return nodes;
}

}  // namespace acus::tissue
