// A load spread over a stated radius has a limit under refinement; one on a single node has none (its sink
// grows like 1 / h, the Boussinesq singularity).
#include <numbers>

#include "insertion.h"

using namespace acus;
using namespace acus::physics;

namespace {

constexpr double travel = 0.5e-3;  // m
constexpr double radius = 5e-3;    // m

// Force of a tip pressed in by `travel` and held until the tissue has come to rest.
double force_at_rest(int tetrahedra, Coupling coupling, bool near_field = false) {
  Scene scene = column_in_table_one(0.1, travel, 5e-3, tetrahedra);
  scene.hand.kind = HandKind::path;
  scene.hand.path = {{0.0, 0.0}, {0.02, travel}, {0.12, travel}};
  scene.contact.coupling = coupling;
  scene.contact.near_field = near_field;
  scene.contact.contact_radius = radius;
  return insert(scene).frames.back().hand_force;
}

// Uniform pressure on a half-space: mean sink 16 (1 - nu^2) F / (3 pi^2 E a) (Love 1929; Johnson 1985,
// Eq. 3.30), in series with the contact spring of 1e4 N/m. The block's own limit is a few per cent stiffer.
double half_space_force() {
  constexpr double pi = std::numbers::pi;
  const double sink_per_newton = 16.0 * (1.0 - 0.48 * 0.48) / (3.0 * pi * pi * 25e3 * radius) + 1e-4;
  return travel / sink_per_newton;
}

TEST(MeshDependence, embedded_contact_converges_to_the_half_space) {
  double before = 1.0;
  for (int tetrahedra : {1000, 5000, 30000}) {
    const double off = force_at_rest(tetrahedra, Coupling::embedded) / half_space_force() - 1.0;
    EXPECT_GT(off, -0.02) << tetrahedra;
    EXPECT_LT(off, 0.8 * before) << tetrahedra;
    before = off;
  }
  EXPECT_LT(before, 0.1);
}

// Mean sink of that disc in the default block for a small load, to which both kinds of elements converge on
// meshes that are refined around the circle up to 392 k tetrahedra (tests/tissue/circular_patch_test.cpp).
constexpr double limit_of_sink = 3.12e-3;  // m/N

TEST(MeshDependence, a_tip_sinks_alike_on_coarse_and_fine_meshes) {
  const double limit = travel / (limit_of_sink + 1e-4);
  for (int tetrahedra : {1000, 5000, 30000})
    EXPECT_NEAR(force_at_rest(tetrahedra, Coupling::embedded, true), limit, 0.08 * limit) << tetrahedra;
}

TEST(MeshDependence, nearest_node_contact_has_no_limit) {
  double before = 1.0;
  for (int tetrahedra : {1000, 5000, 30000}) {
    const double force = force_at_rest(tetrahedra, Coupling::nearest_node);
    EXPECT_LT(force, 0.75 * before) << tetrahedra;
    before = force;
  }
}

}  // namespace
