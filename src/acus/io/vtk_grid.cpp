#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <string>

#include "acus/io/vtk_mesh.h"

namespace acus::io {
namespace {

struct Kind {
  std::int64_t type;
  std::int64_t fewest_points, most_points;
  const char* name;
};
constexpr std::int64_t unbounded = std::numeric_limits<std::int64_t>::max();
constexpr Kind kinds[] = {{1, 1, 1, "vertices"},      {3, 2, 2, "lines"},
                          {5, 3, 3, "triangles"},     {9, 4, 4, "quadrangles"},
                          {10, 4, 4, "tetrahedra"},   {12, 8, 8, "hexahedra"},
                          {13, 6, 6, "wedges"},       {14, 5, 5, "pyramids"},
                          {24, 10, 10, "tetrahedra"}, {71, 4, unbounded, "tetrahedra"}};
constexpr std::string_view tetrahedra = "tetrahedra";

Kind kind_of(std::int64_t type) {
  const auto* known =
      std::find_if(std::begin(kinds), std::end(kinds), [&](const Kind& k) { return k.type == type; });
  return known == std::end(kinds) ? Kind{type, 0, unbounded, "cells of other types"} : *known;
}

}  // namespace

std::size_t region_rank(std::string_view name) {
  return static_cast<std::size_t>(std::find(region_names.begin(), region_names.end(), name) -
                                  region_names.begin());
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
      return draft;
    }
    const Kind kind = kind_of(grid.types[c]);
    if (end - begin < kind.fewest_points || end - begin > kind.most_points) {
      bytes.fail("cell " + std::to_string(c) + " of type " + std::to_string(kind.type) + " (" + kind.name +
                 ") has " + std::to_string(end - begin) + " points; it needs " +
                 std::to_string(kind.fewest_points));
    } else if (kind.name != tetrahedra) {
      ++draft.skipped[kind.name];
    } else {
      DraftTet tet{static_cast<std::int64_t>(c), {}, grid.region.empty() ? 0 : grid.region[c], grid.lines[c]};
      std::copy_n(grid.connectivity.begin() + begin, 4, tet.nodes.begin());
      draft.tets.push_back(tet);
    }
  }
  return draft;
}

}  // namespace acus::io
