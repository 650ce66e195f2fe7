// Irregular meshes for properties that must hold for any mesh.
#pragma once

#include <rapidcheck.h>

#include <algorithm>
#include <numeric>
#include <random>

#include "acus/mesh/block.h"

namespace acus::mesh {

// The same mesh with its nodes and tetrahedra in another order.
inline TetMesh shuffled(const TetMesh& mesh, unsigned seed) {
  std::mt19937 random(seed);
  std::vector<int> new_number(mesh.nodes.size());
  std::iota(new_number.begin(), new_number.end(), 0);
  std::shuffle(new_number.begin(), new_number.end(), random);
  std::vector<std::size_t> order(mesh.tets.size());
  std::iota(order.begin(), order.end(), 0U);
  std::shuffle(order.begin(), order.end(), random);
  TetMesh result;
  result.nodes.resize(mesh.nodes.size());
  for (std::size_t n = 0; n < mesh.nodes.size(); ++n) {
    result.nodes[static_cast<std::size_t>(new_number[n])] = mesh.nodes[n];
  }
  for (std::size_t t : order) {
    Tet tet = mesh.tets[t];
    for (int& n : tet) n = new_number[static_cast<std::size_t>(n)];
    result.tets.push_back(tet);
    result.region.push_back(mesh.region[t]);
  }
  return result;
}

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
