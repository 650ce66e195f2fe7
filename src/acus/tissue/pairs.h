// Tetrahedra two by two: those of a pair share a face, so that five nodes serve both. Half of what the
// kernels do is fetching numbers of nodes and adding to them.
#pragma once

#include <array>
#include <vector>

#include "acus/mesh/tet_mesh.h"

namespace acus::tissue {

// Pairs stand in batches, as many side by side as floats fill 64 bytes: first the one sides, then the others.
inline constexpr int batch_pairs = 16;
inline constexpr int batch_elements = 2 * batch_pairs;

// Where one side of a pair stands among the elements.
inline constexpr std::size_t element_of_pair(std::size_t pair, int side) {
  return pair / batch_pairs * batch_elements + static_cast<std::size_t>(side) * batch_pairs +
         pair % batch_pairs;
}

// The elements of a mesh. Each of its tetrahedra is one; a few more without volume fill the batches and stand
// beside those that have no partner.
struct Pairing {
  std::vector<mesh::Tet> corners;  // [elements]; a pair's are (a b c d) and (a c b e)
  std::vector<int> tet;            // [elements] of the mesh
  std::vector<int> element;        // [tets] the one that has its volume
};
// Neighbours in the list of tetrahedra stay near each other; those of a batch are apart.
Pairing pair_up(const std::vector<mesh::Tet>& tets);

}  // namespace acus::tissue
