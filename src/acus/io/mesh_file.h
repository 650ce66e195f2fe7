// Tetrahedral meshes from files: Gmsh 1, 2 and 4.1, VTK legacy and VTU; told apart by what is in them.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "acus/base/result.h"
#include "acus/mesh/tet_mesh.h"

namespace acus::io {

// The tetrahedra of the file, checked (mesh::checked); `unit_m` is the length of the file's unit in metres.
// Everything but tetrahedra is passed over; those of higher order are taken by their corners. Error: one
// sentence with file, line, node or element, what is wrong and what would be right.
Result<mesh::TetMesh> read_mesh(const std::string& path, double unit_m);

// The same from bytes in memory; `file` is what sentences call them.
Result<mesh::TetMesh> read_mesh_bytes(std::string_view bytes, const std::string& file, double unit_m);

// The hash of the file's bytes, so that another file of the same name can be told.
Result<std::uint64_t> mesh_file_hash(const std::string& path);

}  // namespace acus::io
