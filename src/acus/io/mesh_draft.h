// What every mesh format comes to before it is checked: numbered nodes and tetrahedra that know their line.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "acus/base/result.h"
#include "acus/io/mesh_bytes.h"
#include "acus/mesh/tet_mesh.h"

namespace acus::io {

struct DraftNode {
  std::int64_t number = 0;
  Vec3 position = Vec3::Zero();  // in the file's unit
  long line = 0;                 // 0 in binary files
};

struct DraftTet {
  std::int64_t number = 0;
  std::array<std::int64_t, 4> nodes{};
  std::int64_t region = 0;
  long line = 0;
};

struct MeshDraft {
  std::string node_word = "node", tet_word = "element";  // what the format calls them
  std::vector<DraftNode> nodes;
  std::vector<DraftTet> tets;
  std::map<std::string, std::int64_t> skipped;  // kind of element ("hexahedra") -> how many
};

// Three coordinates of the node called `name`.
Vec3 read_position(MeshBytes& bytes, NumberType type, const std::string& name);

// The mesh in metres, checked (mesh::checked). Error: a number used twice, a tetrahedron with a node that is
// not there, a coordinate that is not finite or beyond 1e6 m, no tetrahedra, or what mesh::checked refuses;
// with file and line.
Result<mesh::TetMesh> finished(const MeshDraft& draft, const std::string& file, double unit_m);

}  // namespace acus::io
