// The table of devices: every row is whole and says where its numbers come from.
#include "acus/haptics/device_limits.h"

#include <gtest/gtest.h>

namespace acus::haptics {
namespace {

TEST(DeviceLimits, every_row_is_whole_and_cites_its_source) {
  ASSERT_GE(known_devices().size(), 4u);
  for (const DeviceLimits& row : known_devices()) {
    EXPECT_FALSE(row.title.empty()) << row.name;
    EXPECT_FALSE(row.source.empty()) << row.name;
    EXPECT_GT(row.peak_force, 0.0) << row.name;
    EXPECT_GT(row.continuous_force, 0.0) << row.name;
    EXPECT_LE(row.continuous_force, row.peak_force) << row.name;
    EXPECT_GT(row.stiffness, 0.0) << row.name;
    EXPECT_GT(row.mass, 0.0) << row.name;
    EXPECT_GT(row.viscous, 0.0) << row.name;
    EXPECT_GE(row.coulomb, 0.0) << row.name;
    EXPECT_GT(row.quantum, 0.0) << row.name;
    EXPECT_NEAR(row.forward.norm(), 1.0, 1e-12) << row.name;
  }
}

TEST(DeviceLimits, units_of_the_table_become_SI) {
  const DeviceLimits* touch = find_device_limits("touch");
  ASSERT_NE(touch, nullptr);
  EXPECT_DOUBLE_EQ(touch->mass, 0.045);
  EXPECT_DOUBLE_EQ(touch->quantum, 0.055e-3);
  EXPECT_DOUBLE_EQ(find_device_limits("inverse3")->delay, 1e-3);
  EXPECT_EQ(find_device_limits("nothing"), nullptr);
}

}  // namespace
}  // namespace acus::haptics
