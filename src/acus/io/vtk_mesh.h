// VTK's unstructured grids: legacy .vtk (text or binary, to version 5.1) and .vtu (XML; text, base64 or raw).
// https://docs.vtk.org/en/latest/design_documents/VTKFileFormats.html
#pragma once

#include <array>
#include <string_view>

#include "acus/io/mesh_draft.h"

namespace acus::io {

// The tetrahedra, their points, and as region the first of the cell arrays "region", "gmsh:physical",
// "medit:ref", "material" and "CellEntityIds" (Gmsh's) that the file has. Quadratic tetrahedra are taken by
// their corners. A failure is in `bytes`.
MeshDraft read_vtk_legacy(MeshBytes& bytes);

// The same from XML. A file that is packed by a compressor, or that has several pieces, is refused.
Result<MeshDraft> read_vtu(std::string_view bytes, const std::string& file);

// Cell arrays that may hold the region, the most telling first.
inline constexpr std::array<std::string_view, 5> region_names = {"region", "gmsh:physical", "medit:ref",
                                                                 "material", "CellEntityIds"};

// What both come to: points in order, and cells in rows.
struct VtkGrid {
  std::vector<DraftNode> points;
  std::vector<std::int64_t> connectivity;         // points of all cells, cell by cell
  std::vector<std::int64_t> ends;                 // of each cell's row in connectivity
  std::vector<std::int64_t> types;                // VTK's number of the kind, one a cell
  std::vector<long> lines;                        // one a cell
  std::vector<std::int64_t> region;               // one a cell, or none at all
  std::size_t region_rank = region_names.size();  // place of its array in region_names; size() for none
};
// Place of `name` in region_names; size() for another.
std::size_t region_rank(std::string_view name);
// A value of a region array, which may be written as a real number; fails unless it is whole and fits an int.
std::int64_t as_region(double value, MeshBytes& bytes);
// The tetrahedra of the grid; fails where rows or counts do not fit together.
MeshDraft draft_of(const VtkGrid& grid, MeshBytes& bytes);

}  // namespace acus::io
