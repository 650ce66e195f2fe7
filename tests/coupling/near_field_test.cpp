#include "acus/coupling/near_field.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace acus::coupling {
namespace {

// Compliances from the formulas of a line load in plane strain and in antiplane shear, worked out by hand for
// Table I (G = 8446 Pa, nu = 0.48), elements of 10 mm and a radius of 0.3 mm: ln(0.3 * 10 / 0.3) = 2.302585.
TEST(NearField, is_what_a_ring_between_shaft_and_mesh_gives_way_by) {
  const double G = 25e3 / 2.96;
  const NearField near = near_field(G, 0.48, 10e-3, 0.3e-3);
  EXPECT_NEAR(1.0 / near.lateral, (3.0 - 1.92) / (8.0 * std::numbers::pi * G * 0.52) * 2.302585,
              1e-6 / near.lateral);
  EXPECT_NEAR(1.0 / near.axial, 2.302585 / (2.0 * std::numbers::pi * G), 1e-6 / near.axial);
}

TEST(NearField, is_softer_in_a_coarser_mesh_and_never_infinite) {
  double before = near_field(8e3, 0.48, 0.1e-3, 0.3e-3).lateral;
  EXPECT_TRUE(std::isfinite(before));
  for (const double edge : {1e-3, 2e-3, 5e-3, 20e-3}) {
    const double now = near_field(8e3, 0.48, edge, 0.3e-3).lateral;
    EXPECT_LE(now, before);
    before = now;
  }
}

}  // namespace
}  // namespace acus::coupling
