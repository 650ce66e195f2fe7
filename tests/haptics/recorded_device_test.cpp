#include "acus/haptics/recorded_device.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "acus/haptics/recorder.h"
#include "acus/io/replay.h"
#include "serving.h"

namespace acus::haptics {
namespace {

const DeviceLimits& touch() { return *find_device_limits("touch"); }

TEST(RecordedHand, rests_glides_and_goes_the_recorded_way) {
  const RecordedDevice device(touch(), {5e-3, 6e-3, 8e-3}, 0.1);
  EXPECT_EQ(device.travel(0.0), -5e-3);
  EXPECT_EQ(device.travel(1.0), -5e-3);
  EXPECT_NEAR(device.travel(1.5), 0.0, 1e-15);  // half of 10 mm at 10 mm/s
  EXPECT_NEAR(device.travel(2.0), 5e-3, 1e-15);
  EXPECT_NEAR(device.travel(2.05), 5.5e-3, 1e-15);
  EXPECT_NEAR(device.travel(2.15), 7e-3, 1e-15);
  EXPECT_EQ(device.travel(2.2), 8e-3);
  EXPECT_EQ(device.travel(100.0), 8e-3);
}

TEST(RecordedHand, that_begins_where_the_loop_does_begins_at_once) {
  const RecordedDevice device(touch(), {-5e-3, 0.0}, 1.0);
  EXPECT_EQ(device.travel(1.0), -5e-3);
  EXPECT_NEAR(device.travel(1.5), -2.5e-3, 1e-15);
}

TEST(RecordedHand, is_served_from_its_file) {
  const std::string file = testing::TempDir() + "recorded_hand.acusrec";
  std::filesystem::remove(file);
  Scene scene;
  scene.tissue.rigid = true;
  {
    auto recorder = Recorder::start(file, *io::recorded_scene(scene), "--record").value();
    for (int i = 0; i < 100; ++i) recorder->step(-5e-3 + 1e-5 * i);
    EXPECT_FALSE(recorder->finish(0));
  }
  const auto device = open_recorded(file).value();
  Steady tick;
  Serving serving(*device, tick);
  EXPECT_TRUE(wait_for([&] { return tick.calls > 1300; }));
  EXPECT_FALSE(serving.stop());
  EXPECT_TRUE(tick.time_goes_on);
  EXPECT_LT((tick.last.position - (-5e-3 + 0.99e-3) * touch().forward).norm(), 1e-12);
}

TEST(RecordedHand, says_what_is_wrong_with_its_file) {
  const auto refusal = [](const std::string& argument) {
    const auto device = open_recorded(argument);
    return device ? "" : device.error().sentence;
  };
  expect_one_sentence_with(refusal(""), "recorded:hand.acusrec");
  expect_one_sentence_with(refusal("/nowhere/hand.acusrec"), "/nowhere/hand.acusrec");
  const std::string file = testing::TempDir() + "nobody.acusrec";
  std::filesystem::remove(file);
  Scene scene;
  scene.tissue.rigid = true;
  EXPECT_FALSE(Recorder::start(file, *io::recorded_scene(scene), "--record").value()->finish(0));
  expect_one_sentence_with(refusal(file), "no step of a hand");
}

}  // namespace
}  // namespace acus::haptics
