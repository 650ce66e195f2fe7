// Files that ParaView opens: tissue as .vtu, the needle as .vtp, and a .pvd that plays them in time.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "acus/base/vec.h"
#include "acus/mesh/tet_mesh.h"

namespace acus::io {

// The state of the tissue at one moment. Points are drawn where they are now.
struct TissueState {
  const mesh::TetMesh& rest;
  std::span<const Vec3> positions;    // m, one per node
  std::span<const Vec3> velocities;   // m/s, one per node
  std::span<const double> von_mises;  // Pa, one per tetrahedron
};

// UnstructuredGrid with displacement [m] and velocity [m/s] at the nodes, von_mises [Pa] and region in the
// cells.
std::string tissue_vtu(const TissueState& tissue);

// PolyData with one line through the points [m].
std::string needle_vtp(std::span<const Vec3> line);

struct TimedFile {
  double time;       // s
  int part;          // 0 tissue, 1 needle
  std::string file;  // relative to the .pvd
};
std::string pvd(std::span<const TimedFile> files);

}  // namespace acus::io
