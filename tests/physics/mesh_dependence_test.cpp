// A load spread over a stated radius has a limit under refinement; one on a single node has none (its sink
// grows like 1 / h, the Boussinesq singularity).
#include "insertion.h"

using namespace acus;
using namespace acus::physics;

namespace {

double force_at(double travel, int tetrahedra, Coupling coupling) {
  Scene scene = table_one(0.1, travel, 5e-3, tetrahedra);
  scene.contact.coupling = coupling;
  scene.contact.contact_radius = 5e-3;
  scene.run.solver_tolerance = 1e-5;
  return insert(scene).frames.back().hand_force;
}

TEST(MeshDependence, embedded_converges_and_nearest_node_does_not) {
  constexpr double travel = 0.5e-3;
  const double embedded[] = {force_at(travel, 2000, Coupling::embedded),
                             force_at(travel, 8000, Coupling::embedded),
                             force_at(travel, 32000, Coupling::embedded)};
  const double nearest[] = {force_at(travel, 2000, Coupling::nearest_node),
                            force_at(travel, 8000, Coupling::nearest_node),
                            force_at(travel, 32000, Coupling::nearest_node)};
  const double first = 1.0 - embedded[1] / embedded[0];
  const double second = 1.0 - embedded[2] / embedded[1];
  EXPECT_LT(std::abs(second), 0.05);
  EXPECT_LT(std::abs(second), 0.7 * std::abs(first));
  EXPECT_GT(1.0 - nearest[1] / nearest[0], 0.25);
  EXPECT_GT(1.0 - nearest[2] / nearest[1], 0.25);
}

}  // namespace
