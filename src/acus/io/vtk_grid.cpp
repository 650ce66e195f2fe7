#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <string>

#include "acus/io/vtk_mesh.h"

namespace acus::io {
namespace {

constexpr std::int64_t tetrahedron = 10, quadratic_tetrahedron = 24, lagrange_tetrahedron = 71;
constexpr std::string_view region_names[] = {"region", "gmsh:physical", "medit:ref", "material"};

std::string kind_name(std::int64_t type) {
  switch (type) {
    case 1:
      return "vertices";
    case 3:
      return "lines";
    case 5:
      return "triangles";
    case 9:
      return "quadrangles";
    case 12:
      return "hexahedra";
    case 13:
      return "wedges";
    case 14:
      return "pyramids";
    default:
      return "cells of type " + std::to_string(type);
  }
}

bool is_tetrahedron(std::int64_t type) {
  return type == tetrahedron || type == quadratic_tetrahedron || type == lagrange_tetrahedron;
}

}  // namespace

std::size_t region_rank(std::string_view name) {
  return static_cast<std::size_t>(std::find(std::begin(region_names), std::end(region_names), name) -
                                  std::begin(region_names));
}

std::int64_t as_region(double value, MeshBytes& bytes) {
  if (std::abs(value) <= std::numeric_limits<int>::max() && value == std::round(value)) {
    return static_cast<std::int64_t>(value);
  }
  bytes.fail("a region number is not whole, or too large");
  return 0;
}

MeshDraft draft_of(const VtkGrid& grid, MeshBytes& bytes) {
  MeshDraft draft;
  draft.node_word = "point";
  draft.tet_word = "cell";
  draft.nodes = grid.points;
  const std::size_t cells = grid.ends.size();
  if (grid.types.size() != cells) {
    bytes.fail("there are " + std::to_string(cells) + " cells, but " + std::to_string(grid.types.size()) +
               " cell types");
  }
  if (!grid.region.empty() && grid.region.size() != cells) {
    bytes.fail("there are " + std::to_string(cells) + " cells, but " + std::to_string(grid.region.size()) +
               " regions");
  }
  std::int64_t begin = 0;
  for (std::size_t c = 0; c < cells && !bytes.failed(); begin = grid.ends[c++]) {
    const auto end = grid.ends[c];
    if (end < begin || end > static_cast<std::int64_t>(grid.connectivity.size())) {
      bytes.fail("cell " + std::to_string(c) + " ends at entry " + std::to_string(end) +
                 " of the connectivity, which has " + std::to_string(grid.connectivity.size()) +
                 "; offsets must grow and end there");
    } else if (!is_tetrahedron(grid.types[c])) {
      ++draft.skipped[kind_name(grid.types[c])];
    } else if (end - begin < 4) {
      bytes.fail("cell " + std::to_string(c) + " is a tetrahedron with " + std::to_string(end - begin) +
                 " points; it needs four");
    } else {
      DraftTet tet{static_cast<std::int64_t>(c), {}, grid.region.empty() ? 0 : grid.region[c], grid.lines[c]};
      std::copy_n(grid.connectivity.begin() + begin, 4, tet.nodes.begin());
      draft.tets.push_back(tet);
    }
  }
  return draft;
}

}  // namespace acus::io
