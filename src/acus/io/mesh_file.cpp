#include "acus/io/mesh_file.h"

#include <cmath>

#include "acus/base/hash.h"
#include "acus/io/gmsh_mesh.h"
#include "acus/io/mesh_draft.h"
#include "acus/io/text_file.h"
#include "acus/io/vtk_mesh.h"

namespace acus::io {
namespace {

// Bytes; some two million tetrahedra, twice what a step is meant for. While it is read, a file takes up to 25
// times its size of memory.
constexpr std::size_t largest_file = 256U << 20U;
constexpr std::string_view utf8_mark = "\xEF\xBB\xBF";

bool is_utf16(std::string_view bytes) {
  return bytes.starts_with("\xFF\xFE") || bytes.starts_with("\xFE\xFF");
}

}  // namespace

Result<mesh::TetMesh> read_mesh_bytes(std::string_view bytes, const std::string& file, double unit_m) {
  if (!(unit_m > 0.0) || !std::isfinite(unit_m))
    return Error{file + ": the unit of a mesh must be a positive length"};
  if (is_utf16(bytes)) return Error{file + ": this is UTF-16 text; save it as plain ASCII or UTF-8"};
  if (bytes.starts_with(utf8_mark)) bytes.remove_prefix(utf8_mark.size());
  MeshBytes cursor(bytes, file);
  const std::string first(cursor.peek_word());
  if (first.starts_with("<")) {
    const auto draft = read_vtu(bytes, file);
    if (!draft) return draft.error();
    return finished(*draft, file, unit_m);
  }
  const bool is_vtk = bytes.starts_with("# vtk DataFile");
  if (!is_vtk && !first.starts_with("$")) {
    return Error{file +
                 (first.empty() ? ": the file is empty"
                                : ": this is no mesh that can be read, it begins with " + quoted(first)) +
                 "; expected Gmsh (1, 2.2 or 4.1) or VTK (.vtk, .vtu), to which meshio converts most others"};
  }
  const MeshDraft draft = is_vtk ? read_vtk_legacy(cursor) : read_gmsh(cursor);
  if (cursor.failed()) return Error{cursor.sentence()};
  return finished(draft, file, unit_m);
}

Result<mesh::TetMesh> read_mesh(const std::string& path, double unit_m) {
  const auto bytes = read_text(path, largest_file);
  if (!bytes) return bytes.error();
  return read_mesh_bytes(*bytes, path, unit_m);
}

Result<std::uint64_t> mesh_file_hash(const std::string& path) {
  const auto bytes = read_text(path, largest_file);
  if (!bytes) return bytes.error();
  return hash_of_bytes(*bytes);
}

}  // namespace acus::io
