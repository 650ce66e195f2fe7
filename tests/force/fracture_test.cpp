// Eq. 15-16 with numbers.
#include "acus/force/fracture.h"

#include <gtest/gtest.h>

#include <numbers>

namespace acus::force {
namespace {

TEST(Fracture, force_for_bovine_liver_and_the_needle_of_table_1) {
  // 2 pi 0.3 mm x 164 J/m^2 (Gokgol 2012) = 0.30913 N
  EXPECT_NEAR(cutting_force(164.0, Crack::ring, 0.3e-3), 0.30913, 5e-6);
  EXPECT_NEAR(cutting_force(164.0, Crack::slit, 0.3e-3), 0.0984, 1e-12);
}

TEST(Fracture, ring_takes_pi_times_the_force_of_a_slit) {
  for (double radius : {0.1e-3, 0.3e-3, 1e-3})
    EXPECT_DOUBLE_EQ(cutting_force(100.0, Crack::ring, radius) / cutting_force(100.0, Crack::slit, radius),
                     std::numbers::pi);
}

TEST(Fracture, work_of_a_cut_is_toughness_times_the_area_it_opens) {
  const double radius = 0.3e-3, depth = 20e-3;
  const double area = 2.0 * std::numbers::pi * radius * depth;  // the wall of a cylinder
  EXPECT_NEAR(cutting_force(164.0, Crack::ring, radius) * depth, 164.0 * area, 1e-15);
}

}  // namespace
}  // namespace acus::force
