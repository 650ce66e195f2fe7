// The recorder against disks that are slow, full or gone; the threads that keep time never notice.
#include "acus/haptics/recorder.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>

#include "acus/io/recording_reader.h"
#include "acus/io/replay.h"

namespace acus::haptics {
namespace {

namespace fs = std::filesystem;

std::string fresh_path(const std::string& name) {
  const std::string path = ::testing::TempDir() + "acus_" + std::to_string(getpid()) + "_" + name;
  fs::remove(path);
  return path;
}

io::RecordedScene some_scene() { return *io::recorded_scene(Scene{}); }

std::unique_ptr<Recorder> start(const std::string& path, RecorderSizes sizes = {}) {
  auto recorder = Recorder::start(path, some_scene(), "--record", sizes);
  EXPECT_TRUE(recorder) << recorder.error().sentence;
  return std::move(recorder).value();
}

// In metres; a step of its own each.
double travel_of(long step) { return 1e-6 * static_cast<double>(step); }

void sleep_ms(int time) { std::this_thread::sleep_for(std::chrono::milliseconds(time)); }

// From now until it is gone, no file of this process grows beyond `bytes`.
class FileLimit {
 public:
  explicit FileLimit(rlim_t bytes) : handler_(std::signal(SIGXFSZ, SIG_IGN)) {
    getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit smaller{bytes, before_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &smaller);
  }
  ~FileLimit() {
    setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, handler_);
  }

 private:
  rlimit before_{};
  void (*handler_)(int);
};

TEST(Recorder, writes_down_both_threads_and_the_end) {
  const std::string path = fresh_path("both");
  constexpr long steps = 2000, ticks = 3000;
  const auto recorder = start(path);
  std::thread device([&] {
    for (long i = 0; i < ticks; ++i) {
      io::RecordedTick tick;
      tick.time = 1e-3 * static_cast<double>(i);
      recorder->tick(tick);
      if (i % 100 == 0) sleep_ms(5);
    }
  });
  for (long i = 1; i <= steps; ++i) {
    recorder->step(travel_of(i), recorder->hash_due() ? std::optional<std::uint64_t>(i) : std::nullopt);
    if (i % 100 == 0) sleep_ms(25);
  }
  device.join();
  EXPECT_FALSE(recorder->finish(4711));
  const auto recording = io::read_recording(path, io::Ticks::read);
  ASSERT_TRUE(recording) << recording.error().sentence;
  EXPECT_TRUE(recording->whole) << recording->loss;
  ASSERT_EQ(recording->travels.size(), static_cast<std::size_t>(steps));
  for (long i = 1; i <= steps; ++i)
    ASSERT_EQ(recording->travels[static_cast<std::size_t>(i - 1)], travel_of(i));
  ASSERT_EQ(recording->hashes.size(), steps / Recorder::hash_stride + 1);
  EXPECT_EQ(recording->hashes[1].step, Recorder::hash_stride + 1);
  EXPECT_EQ(recording->hashes[1].hash, Recorder::hash_stride + 1);
  EXPECT_EQ(recording->hashes.back().hash, 4711U);
  ASSERT_EQ(recording->ticks.size(), static_cast<std::size_t>(ticks));
  EXPECT_EQ(recording->ticks[2999].time, 2.999);
  EXPECT_EQ(recording->ticks_lost, 0U);
  fs::remove(path);
}

TEST(Recorder, has_its_scene_on_the_disk_before_the_first_step) {
  const std::string path = fresh_path("scene");
  const auto recorder = start(path);
  const auto recording = io::read_recording(path);
  ASSERT_TRUE(recording) << recording.error().sentence;
  EXPECT_EQ(recording->travels.size(), 0U);
  EXPECT_FALSE(fs::exists(path + ".part"));
  fs::remove(path);
}

TEST(Recorder, that_is_not_finished_leaves_a_session_that_was_broken_off) {
  const std::string path = fresh_path("broken_off");
  start(path)->step(1e-3);
  const auto recording = io::read_recording(path);
  ASSERT_TRUE(recording);
  EXPECT_EQ(recording->travels, std::vector<double>{1e-3});
  EXPECT_FALSE(recording->whole);
  fs::remove(path);
}

// More than the ring holds, faster than any disk: the beginning is kept, the hole is told twice.
TEST(Recorder, a_hole_is_told_and_ends_the_steps) {
  const std::string path = fresh_path("hole");
  const auto recorder = start(path, {8, 8});
  for (long i = 1; i <= 100'000; ++i) recorder->step(travel_of(i));
  for (long i = 1; i <= 100'000; ++i) recorder->tick({});
  const auto failure = recorder->finish(1);
  ASSERT_TRUE(failure);
  EXPECT_EQ(failure->sentence.rfind(path + ": the disk did not keep up; the recording has no steps from ", 0),
            0U)
      << failure->sentence;
  const auto recording = io::read_recording(path, io::Ticks::read);
  ASSERT_TRUE(recording);
  EXPECT_FALSE(recording->whole);
  EXPECT_NE(recording->loss.find("the disk was too slow"), std::string::npos) << recording->loss;
  EXPECT_GE(recording->travels.size(), 8U);
  EXPECT_LT(recording->travels.size(), 100'000U);
  for (std::size_t i = 0; i < recording->travels.size(); ++i)
    ASSERT_EQ(recording->travels[i], travel_of(static_cast<long>(i) + 1));
  EXPECT_EQ(recording->ticks.size() + recording->ticks_lost, 100'000U);
  fs::remove(path);
}

TEST(Recorder, whoever_waits_for_room_loses_nothing) {
  const std::string path = fresh_path("wait");
  const auto recorder = start(path, {64, 8});
  constexpr long steps = 2000;
  for (long i = 1; i <= steps; ++i) {
    recorder->wait_for_room();
    recorder->step(travel_of(i));
  }
  EXPECT_FALSE(recorder->finish(1));
  const auto recording = io::read_recording(path);
  ASSERT_TRUE(recording);
  EXPECT_TRUE(recording->whole);
  EXPECT_EQ(recording->travels.size(), static_cast<std::size_t>(steps));
  fs::remove(path);
}

TEST(Recorder, a_disk_that_fills_up_is_told_and_the_beginning_is_kept) {
  const std::string path = fresh_path("fills");
  const auto recorder = start(path);
  const auto begun = fs::file_size(path);
  std::optional<Error> failure;
  long given = 0;
  {
    const FileLimit limit(static_cast<rlim_t>(begun) + 2000);
    while (!recorder->failure() && given < 2'000'000) {
      for (int i = 0; i < 100; ++i) recorder->step(travel_of(++given));
      sleep_ms(20);
    }
    recorder->wait_for_room();  // does not wait for a disk that is full
    for (int i = 0; i < 100'000; ++i) recorder->step(travel_of(++given));
    failure = recorder->finish(1);
  }
  ASSERT_TRUE(failure);
  EXPECT_EQ(failure->sentence.rfind(path + ": cannot be written to its end: ", 0), 0U) << failure->sentence;
  const auto recording = io::read_recording(path);
  ASSERT_TRUE(recording) << recording.error().sentence;
  EXPECT_FALSE(recording->whole);
  EXPECT_LT(recording->travels.size(), static_cast<std::size_t>(given));
  for (std::size_t i = 0; i < recording->travels.size(); ++i)
    ASSERT_EQ(recording->travels[i], travel_of(static_cast<long>(i) + 1));
  fs::remove(path);
}

// /dev/full is a disk that is full; the recording is begun beside its place.
TEST(Recorder, a_full_disk_is_told_at_once_and_what_stood_there_stays) {
  const std::string path = fresh_path("full");
  start(path)->step(1e-3);
  fs::create_symlink("/dev/full", path + ".part");
  const auto refused = Recorder::start(path, some_scene(), "--record");
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().sentence, path +
                                          ": cannot be written to its end: the disk is full; free some space "
                                          "or write elsewhere with --record");
  EXPECT_EQ(io::read_recording(path)->travels.size(), 1U);
  fs::remove(path);
}

TEST(Recorder, replaces_a_recording_and_nothing_else) {
  const std::string path = fresh_path("notes");
  std::ofstream(path) << "notes of the user";
  const auto refused = Recorder::start(path, some_scene(), "--record");
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().sentence,
            path + ": is there already and is no recording; choose another name with --record");
  EXPECT_EQ(fs::file_size(path), 17U);
  fs::remove(path);
  for (int i = 0; i < 2; ++i) EXPECT_FALSE(start(path)->finish(1));
  EXPECT_TRUE(io::read_recording(path)->whole);
  EXPECT_FALSE(Recorder::start("/dev/null", some_scene(), "--record"));
  EXPECT_FALSE(Recorder::start("", some_scene(), "--record"));
  fs::remove(path);
}

}  // namespace
}  // namespace acus::haptics
