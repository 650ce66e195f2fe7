#include "acus/mesh/checked.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <tuple>

namespace acus::mesh {
namespace {

// Smallest height over longest edge, roughly. Files with seven digits do not tell a flatter one from a flat
// one, and its stiffness, 1e12 times that of its neighbours, would drown theirs.
constexpr double flat = 1e-6;

std::size_t at(int i) { return static_cast<std::size_t>(i); }

double longest_edge(const TetMesh& mesh, const Tet& tet) {
  double longest = 0.0;
  for (const auto& [i, j] : tet_edges) {
    longest = std::max(longest, (mesh.nodes[at(tet[i])] - mesh.nodes[at(tet[j])]).norm());
  }
  return longest;
}

// What is wrong with one tetrahedron; turns it round if it is inverted.
std::optional<std::string> fault_of(const TetMesh& mesh, Tet& tet) {
  const int nodes = static_cast<int>(mesh.nodes.size());
  for (int n : tet) {
    if (n < 0 || n >= nodes) {
      return "has a node with index " + std::to_string(n) + "; the mesh has nodes 0 to " +
             std::to_string(nodes - 1);
    }
    if (!mesh.nodes[at(n)].allFinite()) return "has a node whose coordinates are not finite numbers";
  }
  Tet sorted = tet;
  std::sort(sorted.begin(), sorted.end());
  if (std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end()) {
    return "has the same node at two corners; it needs four different ones";
  }
  const double volume = signed_volume(mesh, tet);
  const double longest = longest_edge(mesh, tet);
  if (!(6.0 * std::abs(volume) > flat * longest * longest * longest)) {
    return "is flat: its four corners lie in one plane, so it has no volume";
  }
  if (volume < 0.0) std::swap(tet[2], tet[3]);
  return std::nullopt;
}

struct SidedFace {
  Triangle key;  // its nodes, ascending
  bool even;     // seen from outside the tetrahedron, its nodes turn in the order of the key
  int tet;
};

// All faces of all tetrahedra; those of one key are neighbours.
std::vector<SidedFace> sorted_faces(const TetMesh& mesh) {
  std::vector<SidedFace> faces;
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    for (const auto& [a, b, c] : tet_faces) {
      const Triangle face = {mesh.tets[t][a], mesh.tets[t][b], mesh.tets[t][c]};
      Triangle key = face;
      std::sort(key.begin(), key.end());
      const auto lowest = std::find(face.begin(), face.end(), key[0]) - face.begin();
      faces.push_back({key, face[static_cast<std::size_t>(lowest + 1) % 3] == key[1], static_cast<int>(t)});
    }
  }
  const auto order = [](const SidedFace& f) { return std::tie(f.key, f.even, f.tet); };
  std::sort(faces.begin(), faces.end(), [&](const auto& p, const auto& q) { return order(p) < order(q); });
  return faces;
}

std::optional<std::string> overlap(const std::vector<SidedFace>& faces, const TetName& name_of) {
  const auto same = std::adjacent_find(faces.begin(), faces.end(), [](const auto& p, const auto& q) {
    return p.key == q.key && p.even == q.even;
  });
  if (same == faces.end()) return std::nullopt;
  return name_of((same + 1)->tet) + " overlaps " + name_of(same->tet) +
         ": they lie on the same side of the face they share; a face has one tetrahedron on each side";
}

// Tetrahedra that faces do not join, directly or through others, to the first one (union-find).
std::optional<std::string> loose_piece(const std::vector<SidedFace>& faces, int tets,
                                       const TetName& name_of) {
  std::vector<int> parent(at(tets));
  std::iota(parent.begin(), parent.end(), 0);
  const auto root = [&](int t) {
    while (parent[at(t)] != t) t = parent[at(t)] = parent[at(parent[at(t)])];
    return t;
  };
  for (std::size_t f = 1; f < faces.size(); ++f) {
    if (faces[f].key == faces[f - 1].key) parent[at(root(faces[f].tet))] = root(faces[f - 1].tet);
  }
  int first = -1, count = 0;
  for (int t = tets - 1; t > 0; --t) {
    if (root(t) == root(0)) continue;
    first = t;
    ++count;
  }
  if (count == 0) return std::nullopt;
  return name_of(first) + (count > 1 ? " and " + std::to_string(count - 1) + " more share" : " shares") +
         " no face with the rest of the mesh, only nodes or edges or nothing, and would swing or fall "
         "freely; "
         "keep one piece, or merge the nodes where the pieces touch";
}

void drop_unused_nodes(TetMesh& mesh) {
  std::vector<int> new_number(mesh.nodes.size(), -1);
  for (const Tet& t : mesh.tets) {
    for (int n : t) new_number[at(n)] = 0;
  }
  std::size_t kept = 0;
  for (std::size_t n = 0; n < new_number.size(); ++n) {
    if (new_number[n] < 0) continue;
    mesh.nodes[kept] = mesh.nodes[n];
    new_number[n] = static_cast<int>(kept++);
  }
  mesh.nodes.resize(kept);
  for (Tet& t : mesh.tets) {
    for (int& n : t) n = new_number[at(n)];
  }
}

}  // namespace

Result<TetMesh> checked(TetMesh mesh, const TetName& name_of) {
  if (mesh.tets.empty()) return Error{"the mesh has no tetrahedra"};
  if (mesh.region.size() != mesh.tets.size()) {
    return Error{"the mesh has " + std::to_string(mesh.tets.size()) + " tetrahedra, but " +
                 std::to_string(mesh.region.size()) + " region numbers; it needs one for each"};
  }
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    if (const auto fault = fault_of(mesh, mesh.tets[t]))
      return Error{name_of(static_cast<int>(t)) + " " + *fault};
  }
  const auto faces = sorted_faces(mesh);
  if (const auto sentence = overlap(faces, name_of)) return Error{*sentence};
  if (const auto sentence = loose_piece(faces, static_cast<int>(mesh.tets.size()), name_of))
    return Error{*sentence};
  drop_unused_nodes(mesh);
  return mesh;
}

Result<TetMesh> checked(TetMesh mesh) {
  return checked(std::move(mesh), [](int tet) { return "tetrahedron " + std::to_string(tet); });
}

}  // namespace acus::mesh
