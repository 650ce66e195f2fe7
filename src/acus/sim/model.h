// Model: what stays constant during one insertion, built once from a Scene.
#pragma once

#include <optional>

#include "acus/coupling/channel.h"
#include "acus/coupling/guide.h"
#include "acus/mesh/locator.h"
#include "acus/mesh/path.h"
#include "acus/needle/column.h"
#include "acus/needle/rod.h"
#include "acus/numeric/coarse_space.h"
#include "acus/sim/scene.h"
#include "acus/tissue/motion.h"
#include "acus/tissue/tissue_model.h"

namespace acus {

struct Model {
  Scene scene;
  needle::NeedleSpec needle;  // in front of the hand
  needle::Column column;
  needle::Rod rod;
  double cutting_force = 0.0;    // N
  double point_aside = 0.0;      // m, how far from the needle's axis the point of a bevel cuts
  double grip_compliance = 0.0;  // m/N
  double least_load = 0.0;       // N, below which a solve counts a load as so much
  double tip_stiffness = 0.0;    // N/m, of the contact spring and what the mesh cannot sink by under the tip
  // Of run.solver_tolerance, what a solve has: less where the contact spring is so stiff that what is left
  // unbalanced would show in its force.
  double tolerance_share = 1.0;
  mesh::InsertionPath path;  // entry, direction, length of tissue along it

  // All of the tissue; empty when it is rigid.
  mesh::TetMesh mesh;  // m, at rest; free nodes first
  std::optional<mesh::Locator> locator;
  tissue::TissueModel tissue;
  tissue::Rayleigh damping;
  tissue::StepFactors factors;
  // Of the system matrix at rest: the inverses of its diagonal blocks, and all of it on a coarse grid.
  std::vector<float> inverse_block;
  numeric::CoarseSpace coarse;
  coupling::Attachment entry;               // of the surface at the entry, spread like a tip load
  int disc_rings = coupling::fewest_rings;  // of the points that spread a tip load
  coupling::Channel channel;
  coupling::Guide guide;  // of a rod

  bool rigid() const { return scene.tissue.rigid; }
  double solver_tolerance() const { return tolerance_share * scene.run.solver_tolerance; }
  tissue::Material material() const {
    return {scene.tissue.youngs_modulus, scene.tissue.poisson_ratio, scene.tissue.density};
  }
  bool bends_freely() const { return scene.needle_model == NeedleModel::rod; }
  // Of a channel that may curve, but is filled by this needle.
  int most_cells() const { return static_cast<int>(needle.length / coupling::channel_cell) + 2; }
};

Result<Model> build_model(const Scene& scene, const mesh::TetMesh* mesh);

// Holds a needle's tip at a point of the tissue at rest, its load spread across `axis`.
void attach_disc_into(coupling::Attachment& out, const Model& model, const Vec3& point, const Vec3& axis);
// Holds a point of its shaft.
void attach_shaft_into(coupling::Attachment& out, const Model& model, const Vec3& point);
// Holds the needle point at rest depth `depth` [m] along the path, as the scene's coupling does.
void attach_tip_into(coupling::Attachment& out, const Model& model, double depth);

}  // namespace acus
