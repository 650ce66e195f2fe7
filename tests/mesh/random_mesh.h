// Irregular meshes for properties that must hold for any mesh.
#pragma once

#include <rapidcheck.h>

#include <random>

#include "acus/mesh/block.h"
#include "tests/mesh/shuffled.h"

namespace acus::mesh {

// A block of a few cells, each node moved by up to 15 % of a cell, in random order, with two regions.
inline TetMesh random_mesh() {
  const int nx = *rc::gen::inRange(1, 4), ny = *rc::gen::inRange(1, 4), nz = *rc::gen::inRange(1, 4);
  const unsigned seed = *rc::gen::arbitrary<unsigned>();
  TetMesh mesh = build_block(Vec3(nx, ny, nz), {nx, ny, nz});
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> shift(-0.15, 0.15);
  for (Vec3& x : mesh.nodes) x += Vec3(shift(random), shift(random), shift(random));
  for (int& r : mesh.region) r = static_cast<int>(random() % 2);
  return shuffled(mesh, seed);
}

}  // namespace acus::mesh
