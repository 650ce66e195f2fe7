// The first look at a device, on simulated ones.
#include "acus/haptics/device_check.h"

#include <gtest/gtest.h>

#include "acus/haptics/simulated_device.h"

namespace acus::haptics {
namespace {

const std::atomic<bool> never{false};

TEST(DeviceCheck, pushes_with_at_most_half_a_newton_and_tells_the_limits) {
  const DeviceLimits& touch = *find_device_limits("touch");
  SimulatedDevice device(touch, light_grip, [](double) { return 0.0; });
  const DeviceCheck check = check_device(device, 2.0, never);
  EXPECT_FALSE(check.lost);
  EXPECT_GT(check.largest_force, 0.3);
  EXPECT_LE(check.largest_force, 0.5);
  // The hand's spring of 50 N/m gives way towards the person.
  EXPECT_GT((check.highest - check.lowest).norm(), 1e-3);
  const std::string words = in_words(check, touch);
  for (const char* said : {"3.3 N", "0.88 N", "400 N/m", "ticks a second", "left the gate"})
    EXPECT_NE(words.find(said), std::string::npos) << words;
}

// A device that is never ready ticks, and gets no force.
class Asleep final : public Device {
 public:
  const DeviceLimits& limits() const override { return *find_device_limits("touch"); }
  std::optional<Error> serve(Tick& tick, const std::atomic<bool>& stop) override {
    while (!stop) most = std::max(most, tick(DeviceState{}).force.norm());
    return std::nullopt;
  }
  double most = 0.0;
};

TEST(DeviceCheck, does_not_push_with_a_device_that_is_not_ready) {
  Asleep device;
  const DeviceCheck check = check_device(device, 0.9, never);
  EXPECT_EQ(device.most, 0.0);
  EXPECT_NE(in_words(check, device.limits()).find("never ready"), std::string::npos);
}

TEST(DeviceCheck, ends_when_it_is_told_to) {
  SimulatedDevice device(*find_device_limits("touch"), light_grip, [](double) { return 0.0; });
  const std::atomic<bool> at_once{true};
  EXPECT_LT(check_device(device, 1e6, at_once).period.count(), 1'000'000);
}

}  // namespace
}  // namespace acus::haptics
