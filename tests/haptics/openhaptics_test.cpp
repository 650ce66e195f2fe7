// The OpenHaptics backend against an emulator of its driver (fake_hd.cpp): what the device says arrives in
// SI, what tick returns leaves unchanged, and however a session ends, it ends without force.
#include "acus/haptics/openhaptics.h"

#include <cstdlib>

#include "acus/haptics/backends.h"
#include "emulators/fake_hd.h"
#include "serving.h"

namespace acus::haptics {
namespace {

const std::string library = ACUS_BUILD_DIR "/emulators/libHD.so";
const std::string other_library = ACUS_BUILD_DIR "/emulators/libdhd.so";
constexpr unsigned int comm_error = 0x0302;

#define EMULATOR(function) emulator_function<decltype(function)>(library, #function)

class OpenHaptics : public testing::Test {
 protected:
  void SetUp() override {
    setenv("ACUS_LIBHD", library.c_str(), 1);
    EMULATOR(fake_hd_reset)();
  }
  void TearDown() override { unsetenv("ACUS_LIBHD"); }

  static std::unique_ptr<Device> open(const FakeHdSetup& setup = {}, const std::string& name = "") {
    EMULATOR(fake_hd_setup)(&setup);
    Result<std::unique_ptr<Device>> device = open_openhaptics(name);
    if (device) return std::move(device).value();
    ADD_FAILURE() << device.error().sentence;
    return nullptr;
  }
  static std::string refusal(const FakeHdSetup& setup = {}, const std::string& name = "") {
    EMULATOR(fake_hd_setup)(&setup);
    const Result<std::unique_ptr<Device>> device = open_openhaptics(name);
    return device ? "" : device.error().sentence;
  }
  static FakeHdReport report() {
    FakeHdReport report;
    EMULATOR(fake_hd_report)(&report);
    return report;
  }
  static bool wait_for_frames(long frames) {
    const long begun = report().frames;
    return wait_for([&] { return report().frames >= begun + frames; });
  }
  static Vec3 force() { return Eigen::Map<const Vec3>(report().force); }
  static Vec3 torque() { return Eigen::Map<const Vec3>(report().torque); }

  static void expect_let_go() {
    const FakeHdReport seen = report();
    EXPECT_EQ(force(), Vec3::Zero().eval());
    EXPECT_EQ(torque(), Vec3::Zero().eval());
    EXPECT_FALSE(seen.open);
    EXPECT_FALSE(seen.scheduled);
    EXPECT_FALSE(seen.scheduler_runs);
  }
};

FakeHdSetup premium() {
  FakeHdSetup setup;
  setup.model = "PHANTOM Premium 6DOF";
  setup.output_dof = 6;
  return setup;
}

TEST_F(OpenHaptics, says_where_the_handle_is_in_SI_and_in_its_own_axes) {
  const auto device = open();
  ASSERT_TRUE(device);
  // A quarter turn about z after a quarter turn about x, by columns: x goes to y, y to z, z to x.
  const double position[3] = {120.0, -45.0, 7.5}, velocity[3] = {-250.0, 1.0, 80.0};  // mm, mm/s
  const double transform[16] = {0, 1, 0, 0, 0, 0, 1, 0, 1, 0, 0, 0, 120.0, -45.0, 7.5, 1};
  EMULATOR(fake_hd_pose)(position, velocity, transform, 0b10);
  Steady tick;
  Serving serving(*device, tick);
  ASSERT_TRUE(wait_for([&] { return tick.calls >= 20; }));
  EXPECT_FALSE(serving.stop().has_value());
  EXPECT_TRUE(tick.last.position.isApprox(Vec3(0.120, -0.045, 0.0075), 1e-14));
  EXPECT_TRUE(tick.last.velocity.isApprox(Vec3(-0.250, 0.001, 0.080), 1e-14));
  EXPECT_EQ((tick.last.orientation * Vec3::UnitX()).eval(), Vec3::UnitY().eval());
  EXPECT_EQ((tick.last.orientation * Vec3::UnitY()).eval(), Vec3::UnitZ().eval());
  EXPECT_EQ(tick.last.buttons, 0b10u);
  EXPECT_TRUE(tick.last.ready);
  EXPECT_TRUE(tick.time_goes_on);
}

TEST_F(OpenHaptics, puts_out_exactly_the_force_of_tick_and_asks_for_a_thousand_frames_a_second) {
  const auto device = open();
  ASSERT_TRUE(device);
  Steady tick(Vec3(1.25, -0.5, 0.75), Vec3(0.1, 0.1, 0.1));
  Serving serving(*device, tick);
  ASSERT_TRUE(wait_for_frames(20));
  EXPECT_EQ(force(), Vec3(1.25, -0.5, 0.75));
  EXPECT_TRUE(report().force_enabled);
  EXPECT_EQ(report().rate, 1000u);
  EXPECT_EQ(report().torques, 0) << "a Touch shows no torque";
}

TEST_F(OpenHaptics, puts_out_torque_in_millinewton_metres_where_the_device_shows_any) {
  const auto device = open(premium());
  ASSERT_TRUE(device);
  Steady tick(Vec3::Zero(), Vec3(0.1, -0.2, 0.05));
  Serving serving(*device, tick);
  ASSERT_TRUE(wait_for_frames(20));
  EXPECT_TRUE(torque().isApprox(Vec3(100.0, -200.0, 50.0), 1e-14)) << torque().transpose();
  EXPECT_FALSE(serving.stop().has_value());
  expect_let_go();
}

TEST_F(OpenHaptics, spring_brings_the_hand_to_rest_between_the_two_anchors) {
  const auto device = open();
  ASSERT_TRUE(device);
  const double of_hand = 150.0, of_tick = 300.0;  // N/m
  const Vec3 goal(0.06, 0.03, -0.02), anchor(-0.03, 0.0, 0.01);
  EMULATOR(fake_hd_send_hand)(of_hand, goal.x(), goal.y(), goal.z());
  Spring tick(of_tick, anchor);
  Serving serving(*device, tick);
  ASSERT_TRUE(wait_for_frames(1500));
  // Hooke: the two springs pull as strongly as each other.
  const Vec3 rest = (of_hand * goal + of_tick * anchor) / (of_hand + of_tick);
  EXPECT_LT((Eigen::Map<const Vec3>(report().position) - rest).norm(), 1e-6);
  EXPECT_LT((force() - of_hand * (rest - goal)).norm(), 1e-3);
}

TEST_F(OpenHaptics, stop_puts_out_zero_and_lets_the_device_go) {
  const auto device = open();
  ASSERT_TRUE(device);
  Steady tick(Vec3(0.0, 2.0, 0.0));
  Serving serving(*device, tick);
  ASSERT_TRUE(wait_for([] { return force().y() == 2.0; }));
  EXPECT_FALSE(serving.stop().has_value());
  expect_let_go();
}

TEST_F(OpenHaptics, can_be_served_again_after_a_stop) {
  const auto device = open({}, "Left Device");
  ASSERT_TRUE(device);
  for (long session = 1; session <= 2; ++session) {
    Steady tick(Vec3(0.0, 0.0, 1.0));
    Serving serving(*device, tick);
    ASSERT_TRUE(wait_for([] { return force().z() == 1.0; }));
    EXPECT_FALSE(serving.stop().has_value());
    EXPECT_EQ(report().opened, session);
    EXPECT_STREQ(report().name, "Left Device");
    expect_let_go();
  }
}

TEST_F(OpenHaptics, puts_out_nothing_while_the_handle_is_not_calibrated) {
  FakeHdSetup setup;
  setup.calibration = 0x5001;
  const auto device = open(setup);
  ASSERT_TRUE(device);
  Steady tick(Vec3(1.0, 0.0, 0.0));
  Serving serving(*device, tick);
  ASSERT_TRUE(wait_for_frames(50));
  EXPECT_GT(tick.calls, 0);  // so that it knows
  EXPECT_EQ(force(), Vec3::Zero().eval());
  EXPECT_FALSE(serving.stop().has_value());
}

TEST_F(OpenHaptics, renews_a_calibration_that_needs_no_person) {
  for (const int style : {1 << 1, 1 << 2}) {
    FakeHdSetup setup;
    setup.calibration = 0x5001;
    setup.calibration_styles = style;
    const auto device = open(setup);
    ASSERT_TRUE(device);
    Steady tick;
    Serving serving(*device, tick);
    EXPECT_TRUE(wait_for([&] { return tick.calls > 0; })) << style;
    EXPECT_FALSE(serving.stop().has_value());
  }
}

TEST_F(OpenHaptics, never_takes_the_place_of_the_handle_for_its_zero_unasked) {
  FakeHdSetup setup;
  setup.calibration = 0x5001;
  setup.calibration_styles = 1 << 0;  // encoder reset
  const auto device = open(setup);
  ASSERT_TRUE(device);
  Steady tick(Vec3(1.0, 0.0, 0.0));
  Serving serving(*device, tick);
  ASSERT_TRUE(wait_for_frames(50));
  EXPECT_EQ(force(), Vec3::Zero().eval());
}

TEST_F(OpenHaptics, error_of_the_driver_ends_the_session_without_force) {
  const auto device = open(premium());
  ASSERT_TRUE(device);
  Steady tick(Vec3(0.0, 2.0, 0.0), Vec3(0.1, 0.0, 0.0));
  Serving serving(*device, tick);
  ASSERT_TRUE(wait_for([] { return force().y() == 2.0; }));
  EMULATOR(fake_hd_raise)(comm_error);
  expect_one_sentence_with(serving.loss(), "HD_COMM_ERROR (0x0302)");
  expect_let_go();
}

TEST_F(OpenHaptics, device_that_falls_silent_is_noticed_and_left_without_force) {
  const auto device = open();
  ASSERT_TRUE(device);
  Steady tick(Vec3(0.0, 2.0, 0.0));
  Serving serving(*device, tick);
  ASSERT_TRUE(wait_for([] { return force().y() == 2.0; }));
  EMULATOR(fake_hd_unplug)();
  expect_one_sentence_with(serving.loss(), "silent");
  expect_let_go();
}

TEST_F(OpenHaptics, loop_that_does_not_start_is_an_error_and_asks_nothing_of_tick) {
  FakeHdSetup setup;
  setup.starts = false;
  const auto device = open(setup);
  ASSERT_TRUE(device);
  Steady tick(Vec3(0.0, 2.0, 0.0));
  Serving serving(*device, tick);
  expect_one_sentence_with(serving.loss(), "cannot start its loop: unknown error (0x0304)");
  EXPECT_EQ(tick.calls, 0);
  expect_let_go();
}

TEST_F(OpenHaptics, limits_are_those_of_the_table_lowered_to_what_the_driver_says) {
  FakeHdSetup weak;
  weak.max_force = 2.5;
  weak.max_continuous = 0.6;
  weak.max_stiffness = 0.25;
  auto device = open(weak);
  ASSERT_TRUE(device);
  EXPECT_EQ(device->limits().name, "touch");
  EXPECT_DOUBLE_EQ(device->limits().peak_force, 2.5);
  EXPECT_DOUBLE_EQ(device->limits().continuous_force, 0.6);
  EXPECT_DOUBLE_EQ(device->limits().stiffness, 250.0);

  FakeHdSetup boastful;
  boastful.max_force = boastful.max_continuous = boastful.max_stiffness = 1000.0;
  device = open(boastful);
  ASSERT_TRUE(device);
  const DeviceLimits& touch = *find_device_limits("touch");
  EXPECT_EQ(device->limits().peak_force, touch.peak_force);
  EXPECT_EQ(device->limits().continuous_force, touch.continuous_force);
  EXPECT_EQ(device->limits().stiffness, touch.stiffness);

  FakeHdSetup peak_below_continuous;
  peak_below_continuous.max_force = 0.5;
  device = open(peak_below_continuous);
  ASSERT_TRUE(device);
  EXPECT_DOUBLE_EQ(device->limits().continuous_force, 0.5);
}

TEST_F(OpenHaptics, model_chooses_the_row_and_torque_needs_six_degrees_of_freedom) {
  auto device = open(premium());
  ASSERT_TRUE(device);
  EXPECT_EQ(device->limits().name, "premium");
  EXPECT_EQ(device->limits().peak_torque, find_device_limits("premium")->peak_torque);
  FakeHdSetup without_torque = premium();
  without_torque.output_dof = 3;
  device = open(without_torque);
  ASSERT_TRUE(device);
  EXPECT_EQ(device->limits().name, "premium");
  EXPECT_EQ(device->limits().peak_torque, 0.0);
}

TEST_F(OpenHaptics, number_that_the_driver_does_not_know_is_no_error_of_the_session) {
  const auto device = open();  // knows none of its nominal limits
  ASSERT_TRUE(device);
  EXPECT_EQ(device->limits().peak_force, find_device_limits("touch")->peak_force);
  Steady tick;
  Serving serving(*device, tick);
  ASSERT_TRUE(wait_for_frames(20));
  EXPECT_FALSE(serving.over());
}

TEST_F(OpenHaptics, device_is_opened_by_its_name_or_as_the_default_one) {
  EXPECT_TRUE(open());
  EXPECT_TRUE(report().default_name);
  const Result<OpenDevice> device = open_device("openhaptics:Right Device");
  ASSERT_TRUE(device.ok()) << device.error().sentence;
  EXPECT_FALSE(report().default_name);
  EXPECT_STREQ(report().name, "Right Device");
}

TEST_F(OpenHaptics, device_that_is_dropped_unserved_is_closed) {
  auto device = open();
  EXPECT_TRUE(report().open);
  device.reset();
  EXPECT_FALSE(report().open);
}

TEST_F(OpenHaptics, refusal_says_which_device_and_why) {
  FakeHdSetup setup;
  setup.refuses = true;
  expect_one_sentence_with(refusal(setup, "Left"), "'Left': HD_DEVICE_FAULT (0x0300)");
  expect_one_sentence_with(refusal(setup), "default device");
  setup.refuses = false;
  setup.calibration = 0x5002;
  expect_one_sentence_with(refusal(setup), "is not calibrated");
  EXPECT_FALSE(report().open);
}

TEST_F(OpenHaptics, missing_driver_or_function_is_one_sentence_that_says_what_to_do) {
  EXPECT_EQ(openhaptics_missing(), "");
  setenv("ACUS_LIBHD", "/nowhere/libHD.so", 1);
  expect_one_sentence_with(openhaptics_missing(), "/nowhere/libHD.so");
  expect_one_sentence_with(openhaptics_missing(), "set ACUS_LIBHD to the path");
  EXPECT_EQ(refusal(), openhaptics_missing());
  setenv("ACUS_LIBHD", other_library.c_str(), 1);
  expect_one_sentence_with(openhaptics_missing(), "has no function hdInitDevice");
  EXPECT_EQ(refusal(), openhaptics_missing());
}

}  // namespace
}  // namespace acus::haptics
