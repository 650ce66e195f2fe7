// The Force Dimension backend against an emulator of its driver (fake_dhd.cpp): numbers arrive and leave as
// they are, and however a session ends, it ends without force.
#include "acus/haptics/force_dimension.h"

#include <array>
#include <cstdlib>

#include "acus/haptics/backends.h"
#include "acus/haptics/shared_library.h"
#include "emulators/fake_dhd.h"
#include "serving.h"

namespace acus::haptics {
namespace {

const std::string library = ACUS_BUILD_DIR "/emulators/libdhd.so";
const std::string other_library = ACUS_BUILD_DIR "/emulators/libHD.so";

#define EMULATOR(function) emulator_function<decltype(function)>(library, #function)

class ForceDimension : public testing::Test {
 protected:
  void SetUp() override {
    setenv("ACUS_LIBDHD", library.c_str(), 1);
    EMULATOR(fake_dhd_reset)();
  }
  void TearDown() override { unsetenv("ACUS_LIBDHD"); }

  static std::unique_ptr<Device> open(const std::string& argument = "") {
    Result<std::unique_ptr<Device>> device = open_force_dimension(argument);
    if (device) return std::move(device).value();
    ADD_FAILURE() << device.error().sentence;
    return nullptr;
  }
  static std::string refusal(const std::string& argument = "") {
    const Result<std::unique_ptr<Device>> device = open_force_dimension(argument);
    return device ? "" : device.error().sentence;
  }
  static FakeDhdReport report() {
    FakeDhdReport report;
    EMULATOR(fake_dhd_report)(&report);
    return report;
  }
  static bool wait_for_forces(long forces) {
    const long begun = report().forces;
    return wait_for([&] { return report().forces >= begun + forces; });
  }
  static Vec3 force() { return Eigen::Map<const Vec3>(report().force); }

  static void expect_force_off() {
    EXPECT_EQ(force(), Vec3::Zero().eval());
    EXPECT_FALSE(report().force_enabled);
  }
};

TEST_F(ForceDimension, says_where_the_handle_is_in_its_own_axes) {
  const auto device = open();
  ASSERT_TRUE(device);
  const double position[3] = {0.01, -0.02, 0.03}, velocity[3] = {0.1, 0.2, -0.3};  // m, m/s
  const double frame[9] = {0, 0, 1, 1, 0, 0, 0, 1, 0};  // by rows: x goes to y, y to z, z to x
  EMULATOR(fake_dhd_pose)(position, velocity, frame, 1);
  Steady tick;
  Serving serving(*device, tick);
  ASSERT_TRUE(wait_for([&] { return tick.calls >= 20; }));
  EXPECT_FALSE(serving.stop().has_value());
  EXPECT_EQ(tick.last.position, Vec3(0.01, -0.02, 0.03));
  EXPECT_EQ(tick.last.velocity, Vec3(0.1, 0.2, -0.3));
  EXPECT_EQ((tick.last.orientation * Vec3::UnitX()).eval(), Vec3::UnitY().eval());
  EXPECT_EQ((tick.last.orientation * Vec3::UnitY()).eval(), Vec3::UnitZ().eval());
  EXPECT_EQ(tick.last.buttons, 1u);
  EXPECT_TRUE(tick.last.ready);
  EXPECT_TRUE(tick.time_goes_on);
}

TEST_F(ForceDimension, puts_out_exactly_the_force_of_tick_under_a_watchdog) {
  const auto device = open();
  ASSERT_TRUE(device);
  Steady tick(Vec3(3.25, -0.5, 7.75));
  Serving serving(*device, tick);
  ASSERT_TRUE(wait_for_forces(20));
  EXPECT_EQ(force(), Vec3(3.25, -0.5, 7.75));
  EXPECT_TRUE(report().force_enabled);
  EXPECT_GT(report().watchdog, 0);
}

TEST_F(ForceDimension, spring_brings_the_hand_to_rest_between_the_two_anchors) {
  const auto device = open();
  ASSERT_TRUE(device);
  const double of_hand = 200.0, of_tick = 600.0;  // N/m
  const Vec3 goal(0.0, 0.05, 0.02), anchor(0.01, -0.03, 0.0);
  EMULATOR(fake_dhd_send_hand)(of_hand, goal.x(), goal.y(), goal.z());
  Spring tick(of_tick, anchor);
  Serving serving(*device, tick);
  ASSERT_TRUE(wait_for_forces(1500));
  // Hooke: the two springs pull as strongly as each other.
  const Vec3 rest = (of_hand * goal + of_tick * anchor) / (of_hand + of_tick);
  EXPECT_LT((Eigen::Map<const Vec3>(report().position) - rest).norm(), 1e-6);
  EXPECT_LT((force() - of_hand * (rest - goal)).norm(), 1e-3);
}

TEST_F(ForceDimension, stop_switches_the_force_off_and_the_device_can_be_served_again) {
  auto device = open();
  ASSERT_TRUE(device);
  for (int session = 0; session < 2; ++session) {
    Steady tick(Vec3(0.0, 2.0, 0.0));
    Serving serving(*device, tick);
    ASSERT_TRUE(wait_for([] { return force().y() == 2.0; }));
    EXPECT_FALSE(serving.stop().has_value());
    expect_force_off();
  }
  device.reset();
  EXPECT_FALSE(report().open);
}

TEST_F(ForceDimension, puts_out_nothing_while_the_handle_is_not_calibrated) {
  const auto device = open();
  ASSERT_TRUE(device);
  EMULATOR(fake_dhd_calibrate)(false);
  Steady tick(Vec3(1.0, 0.0, 0.0));
  Serving serving(*device, tick);
  ASSERT_TRUE(wait_for_forces(50));
  EXPECT_GT(tick.calls, 0);  // so that it knows
  EXPECT_EQ(force(), Vec3::Zero().eval());
  EMULATOR(fake_dhd_calibrate)(true);
  EXPECT_TRUE(wait_for([&] { return force() != Vec3::Zero(); }));
}

TEST_F(ForceDimension, failed_call_ends_the_session_without_force) {
  for (const FakeDhdFailure failure : {fake_dhd_read_fails, fake_dhd_force_fails}) {
    EMULATOR(fake_dhd_reset)();
    const auto device = open();
    ASSERT_TRUE(device);
    Steady tick(Vec3(0.0, 2.0, 0.0));
    Serving serving(*device, tick);
    ASSERT_TRUE(wait_for([] { return force().y() == 2.0; }));
    EMULATOR(fake_dhd_fail)(failure);
    expect_one_sentence_with(serving.loss(), "communication error");
    expect_force_off();
  }
}

TEST_F(ForceDimension, unplugged_device_is_noticed) {
  const auto device = open();
  ASSERT_TRUE(device);
  Steady tick;
  Serving serving(*device, tick);
  ASSERT_TRUE(wait_for([&] { return tick.calls > 0; }));
  EMULATOR(fake_dhd_fail)(fake_dhd_everything);
  expect_one_sentence_with(serving.loss(), "still plugged in");
  Steady never;
  Serving again(*device, never);
  expect_one_sentence_with(again.loss(), "switch its force on");
  EXPECT_EQ(never.calls, 0);
}

TEST_F(ForceDimension, limits_are_those_of_an_omega) {
  const auto device = open();
  ASSERT_TRUE(device);
  EXPECT_EQ(device->limits().name, "omega");
  EXPECT_EQ(device->limits().peak_force, find_device_limits("omega")->peak_force);
}

TEST_F(ForceDimension, device_is_opened_by_its_number) {
  EXPECT_TRUE(open());
  EXPECT_EQ(report().index, 0);
  const Result<OpenDevice> device = open_device("force_dimension:3");
  ASSERT_TRUE(device.ok()) << device.error().sentence;
  EXPECT_EQ(report().index, 3);
  for (const char* wrong : {"x", "-1", "12", "1 "}) expect_one_sentence_with(refusal(wrong), wrong);
}

TEST_F(ForceDimension, refusal_says_why) {
  EMULATOR(fake_dhd_fail)(fake_dhd_open_fails);
  expect_one_sentence_with(refusal(), "no Force Dimension device can be opened (communication error)");
}

TEST_F(ForceDimension, missing_driver_or_function_is_one_sentence_that_says_what_to_do) {
  EXPECT_EQ(force_dimension_missing(), "");
  setenv("ACUS_LIBDHD", "/nowhere/libdhd.so", 1);
  expect_one_sentence_with(force_dimension_missing(), "/nowhere/libdhd.so");
  expect_one_sentence_with(force_dimension_missing(), "set ACUS_LIBDHD to the path");
  EXPECT_EQ(refusal(), force_dimension_missing());
  setenv("ACUS_LIBDHD", other_library.c_str(), 1);
  expect_one_sentence_with(force_dimension_missing(), "has no function dhdOpenID");
  EXPECT_EQ(refusal(), force_dimension_missing());
}

// With made-up names, so that it does not matter whose drivers are installed here.
TEST(SharedLibrary, is_looked_for_under_each_of_its_names) {
  constexpr std::array names = {"libacus_none.so", "libacus_none.so.3"};
  const Result<SharedLibrary> none =
      SharedLibrary::open({"ACUS_LIBNONE", names, "nobody's devices", "make one"});
  ASSERT_FALSE(none);
  expect_one_sentence_with(none.error().sentence, "libacus_none.so:");
  expect_one_sentence_with(none.error().sentence, "libacus_none.so.3:");
}

}  // namespace
}  // namespace acus::haptics
