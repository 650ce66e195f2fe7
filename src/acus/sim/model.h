// Model: what stays constant during one insertion, built once from a Scene.
#pragma once

#include <optional>

#include "acus/coupling/channel.h"
#include "acus/mesh/locator.h"
#include "acus/mesh/path.h"
#include "acus/needle/column.h"
#include "acus/numeric/coarse_space.h"
#include "acus/sim/scene.h"
#include "acus/tissue/motion.h"
#include "acus/tissue/tissue_model.h"

namespace acus {

struct Model {
  Scene scene;
  needle::Column column;
  double cutting_force = 0.0;    // N
  double grip_compliance = 0.0;  // m/N
  mesh::InsertionPath path;      // entry, direction, length of tissue along it

  // All of the tissue; empty when it is rigid.
  mesh::TetMesh mesh;  // m, at rest; free nodes first
  std::optional<mesh::Locator> locator;
  tissue::TissueModel tissue;
  tissue::Rayleigh damping;
  tissue::StepFactors factors;
  numeric::CoarseSpace coarse;              // for the tissue at rest
  coupling::Attachment entry;               // of the surface at the entry, spread like a tip load
  int disc_rings = coupling::fewest_rings;  // of the points that spread a tip load
  coupling::Channel channel;

  bool rigid() const { return scene.tissue.rigid; }
};

Result<Model> build_model(const Scene& scene, const mesh::TetMesh* mesh);

// Holds the needle point at rest depth `depth` [m] along the path, as the scene's coupling does.
void attach_tip_into(coupling::Attachment& out, const Model& model, double depth);

}  // namespace acus
