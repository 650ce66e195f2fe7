#include "acus/io/insertion.h"
#include "acus/io/mesh_file.h"

namespace acus::io {

Result<Simulation> build_simulation(const Scene& scene, int threads) {
  if (scene.tissue.rigid || scene.tissue.mesh.empty()) return Simulation::build(scene, nullptr, threads);
  const Result<mesh::TetMesh> mesh = read_mesh(scene.tissue.mesh, scene.tissue.mesh_unit);
  if (!mesh) return mesh.error();
  return Simulation::build(scene, &*mesh, threads);
}

}  // namespace acus::io
