// A plane cut through a tetrahedral mesh: what the inside looks like.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "acus/base/vec.h"
#include "acus/mesh/tet_mesh.h"

namespace acus::study {

using Point2 = std::array<double, 2>;

// The plane through `origin` spanned by the orthonormal `right` and `up`.
struct CutPlane {
  Vec3 origin{0.0, 0.0, 0.0};
  Vec3 right{1.0, 0.0, 0.0};
  Vec3 up{0.0, 0.0, 1.0};
};

// The point of the plane nearest to `x`, in the plane's own coordinates (right, up). m
Point2 on_plane(const CutPlane& plane, const Vec3& x);

// The plane that holds the axis of insertion (`entry`, unit `direction`) and the bow of `line`: `up` is
// against the insertion, `right` points to where the line leaves the axis furthest, or along x for a straight
// line.
CutPlane plane_of_needle(const Vec3& entry, const Vec3& direction, std::span<const Vec3> line);

// What the plane cuts out of one tetrahedron: a triangle or a quadrilateral, corners in order around it.
struct CutPolygon {
  int tet = 0;
  int corners = 0;
  std::array<Point2, 4> corner{};  // m, in the plane
};

struct Section {
  std::vector<CutPolygon> polygons;            // in order of their tetrahedra
  std::vector<std::array<Point2, 2>> outline;  // m, where the plane leaves the mesh: unordered pieces
};

// Cuts the mesh of `tets` with its nodes at `positions` [m]. A face that lies in the plane is counted once.
Section cut_section(std::span<const Vec3> positions, std::span<const mesh::Tet> tets, const CutPlane& plane);

// m^2
double area(const CutPolygon& polygon);

}  // namespace acus::study
