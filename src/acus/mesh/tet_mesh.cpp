#include "acus/mesh/tet_mesh.h"

namespace acus::mesh {

double signed_volume(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  return (b - a).dot((c - a).cross(d - a)) / 6.0;
}

double signed_volume(const TetMesh& mesh, const Tet& tet) {
  const auto corner = [&](std::size_t i) { return mesh.nodes[static_cast<std::size_t>(tet[i])]; };
  return signed_volume(corner(0), corner(1), corner(2), corner(3));
}

double total_volume(const TetMesh& mesh) {
  double sum = 0.0;
  for (const Tet& tet : mesh.tets) sum += signed_volume(mesh, tet);
  return sum;
}

Eigen::AlignedBox3d bounds(const TetMesh& mesh) {
  Eigen::AlignedBox3d box;
  for (const Vec3& x : mesh.nodes) box.extend(x);
  return box;
}

}  // namespace acus::mesh
