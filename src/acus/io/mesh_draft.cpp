#include "acus/io/mesh_draft.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "acus/mesh/checked.h"

namespace acus::io {
namespace {

constexpr double farthest = 1e6;  // m; no tissue is larger, and its cube still has room among the doubles

// The file's node numbers in ascending order, each with its index.
using Numbering = std::vector<std::pair<std::int64_t, int>>;

Result<Numbering> numbering(const MeshDraft& draft, const std::string& file) {
  Numbering numbers;
  for (const DraftNode& node : draft.nodes)
    numbers.emplace_back(node.number, static_cast<int>(numbers.size()));
  std::sort(numbers.begin(), numbers.end());
  const auto twice = std::adjacent_find(numbers.begin(), numbers.end(),
                                        [](const auto& p, const auto& q) { return p.first == q.first; });
  if (twice == numbers.end()) return numbers;
  const long line = draft.nodes[static_cast<std::size_t>((twice + 1)->second)].line;
  return Error{place(file, line) + draft.node_word + " number " + std::to_string(twice->first) +
               " is given twice; each needs a number of its own"};
}

std::optional<int> index_of(const Numbering& numbers, std::int64_t number) {
  const auto found = std::lower_bound(numbers.begin(), numbers.end(), std::make_pair(number, 0));
  if (found == numbers.end() || found->first != number) return std::nullopt;
  return found->second;
}

Error no_tetrahedra(const MeshDraft& draft, const std::string& file) {
  std::string found;
  for (const auto& [kind, count] : draft.skipped) {
    found += (found.empty() ? "" : ", ") + std::to_string(count) + " " + kind;
  }
  return Error{file + ": the mesh has no tetrahedra, only " + (found.empty() ? "nodes" : found) +
               "; mesh the volume with tetrahedra (in Gmsh: Mesh, 3D)"};
}

}  // namespace

Vec3 read_position(MeshBytes& bytes, NumberType type, const std::string& name) {
  const double x = bytes.real(type, "the x coordinate of " + name);
  const double y = bytes.real(type, "the y coordinate of " + name);
  const double z = bytes.real(type, "the z coordinate of " + name);
  const Vec3 position(x, y, z);
  if (!position.allFinite()) bytes.fail(name + " has a coordinate that is not a finite number");
  return position;
}

Result<mesh::TetMesh> finished(const MeshDraft& draft, const std::string& file, double unit_m) {
  if (draft.tets.empty()) return no_tetrahedra(draft, file);
  const auto numbers = numbering(draft, file);
  if (!numbers) return numbers.error();
  mesh::TetMesh mesh;
  for (const DraftNode& node : draft.nodes) {
    mesh.nodes.push_back(unit_m * node.position);
    if (mesh.nodes.back().cwiseAbs().maxCoeff() <= farthest) continue;
    return Error{place(file, node.line) + draft.node_word + " " + std::to_string(node.number) +
                 " lies more than 1e6 m from the origin; is the unit of the file right?"};
  }
  const auto name_of = [&](int t) {
    const DraftTet& tet = draft.tets[static_cast<std::size_t>(t)];
    return place(file, tet.line) + draft.tet_word + " " + std::to_string(tet.number);
  };
  for (const DraftTet& tet : draft.tets) {
    const int t = static_cast<int>(mesh.tets.size());
    mesh::Tet corners{};
    for (std::size_t i = 0; i < 4; ++i) {
      const auto index = index_of(*numbers, tet.nodes[i]);
      if (!index) {
        return Error{name_of(t) + " uses " + draft.node_word + " " + std::to_string(tet.nodes[i]) +
                     ", which the file does not have"};
      }
      corners[i] = *index;
    }
    using Limits = std::numeric_limits<int>;
    if (tet.region < Limits::min() || tet.region > Limits::max()) {
      return Error{name_of(t) + " has region " + std::to_string(tet.region) + ", which is too large"};
    }
    mesh.tets.push_back(corners);
    mesh.region.push_back(static_cast<int>(tet.region));
  }
  return mesh::checked(std::move(mesh), name_of);
}

}  // namespace acus::io
