// A mesh as a careless file has it.
#pragma once

#include <algorithm>
#include <numeric>
#include <random>

#include "acus/mesh/tet_mesh.h"

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

}  // namespace acus::mesh
