// A session that is killed at any moment leaves a recording of all but its last second, and that replays to
// the same bits. Each session is a process of its own that steps in real time and counts its steps in memory
// that the test sees, so that what was lost is counted against what was done.
#include <gtest/gtest.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <random>
#include <thread>

#include "acus/haptics/recorder.h"
#include "acus/io/insertion.h"
#include "acus/io/recording_reader.h"
#include "acus/io/replay.h"

namespace acus::haptics {
namespace {

constexpr int steps_in_a_second = 1000;
constexpr int longest_life_ms = 1500;

Scene some_scene() {
  Scene scene;
  scene.tissue.tetrahedra = 300;
  scene.hand.speed = 20e-3;  // m/s
  return scene;
}

// Not smooth, as a hand is not.
double travel_of(long step) {
  const double tremor = 1e-5 * static_cast<double>(step * 7919 % 13);  // m
  return 1e-5 * static_cast<double>(step) + tremor;
}

// What a session has done so far, in memory of both processes.
struct Progress {
  std::atomic<long> steps{0};
  std::atomic<bool> failed{false};
};
static_assert(std::atomic<long>::is_always_lock_free);

class SharedProgress {
 public:
  SharedProgress()
      : memory_(mmap(nullptr, sizeof(Progress), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0)) {
    if (memory_ == MAP_FAILED) std::abort();
    new (memory_) Progress;
  }
  ~SharedProgress() { munmap(memory_, sizeof(Progress)); }
  SharedProgress(const SharedProgress&) = delete;
  SharedProgress& operator=(const SharedProgress&) = delete;
  Progress& operator*() const { return *static_cast<Progress*>(memory_); }

 private:
  void* memory_;
};

// Steps no faster than real time until it is killed; never returns.
[[noreturn]] void live(const std::string& path, Progress& progress) {
  const Scene scene = some_scene();
  auto simulation = io::build_simulation(scene);
  auto recorder = Recorder::start(path, *io::recorded_scene(scene), "--record");
  if (!simulation || !recorder) {
    progress.failed = true;
    std::_Exit(1);
  }
  for (long step = 1;; ++step) {
    simulation->step(travel_of(step));
    const bool due = (*recorder)->hash_due();
    (*recorder)->step(travel_of(step), due ? std::optional(simulation->state_hash()) : std::nullopt);
    progress.steps = step;
    std::this_thread::sleep_for(std::chrono::microseconds(1'000'000 / steps_in_a_second));
  }
}

void kill_after(int life_ms, const std::string& path) {
  const SharedProgress progress;
  const pid_t child = fork();
  ASSERT_GE(child, 0);
  if (child == 0) live(path, *progress);
  std::this_thread::sleep_for(std::chrono::milliseconds(life_ms));
  kill(child, SIGKILL);
  waitpid(child, nullptr, 0);
  const long done = (*progress).steps;
  EXPECT_FALSE((*progress).failed);
  if (!std::filesystem::exists(path)) {
    EXPECT_EQ(done, 0) << "killed before its recording was begun";
    return;
  }

  const auto recording = io::read_recording(path);
  ASSERT_TRUE(recording) << recording.error().sentence;
  EXPECT_FALSE(recording->whole);
  const auto kept = static_cast<long>(recording->travels.size());
  EXPECT_LE(kept, done + 1) << "the step that was being counted";
  EXPECT_LE(done - kept, steps_in_a_second) << "more than a second lost";
  for (long step = 1; step <= kept; ++step)
    ASSERT_EQ(recording->travels[static_cast<std::size_t>(step - 1)], travel_of(step));

  auto simulation = io::build_replay(*recording);
  ASSERT_TRUE(simulation) << simulation.error().sentence;
  io::HashCheck check(*recording);
  io::run_insertion(*simulation, io::following(recording->travels), std::ref(check));
  EXPECT_EQ(check.difference().value_or(""), "");
  EXPECT_EQ(check.compared(), static_cast<int>(recording->hashes.size()));
  EXPECT_EQ(check.compared() > 0, kept > 0);
}

// ACUS_KILLS asks for more of them.
TEST(RecorderKill, loses_at_most_a_second_and_replays_to_the_same_bits) {
  const char* asked = std::getenv("ACUS_KILLS");
  const int kills = asked != nullptr ? std::atoi(asked) : 20;
  std::mt19937 random(7);
  for (int kill = 0; kill < kills; ++kill) {
    const int life = std::uniform_int_distribution(0, longest_life_ms)(random);
    SCOPED_TRACE("killed after " + std::to_string(life) + " ms");
    const std::string path = ::testing::TempDir() + "acus_kill_" + std::to_string(getpid()) + ".acusrec";
    kill_after(life, path);
    for (const std::string& file : {path, path + ".part"}) std::filesystem::remove(file);
    if (::testing::Test::HasFailure()) return;
  }
}

}  // namespace
}  // namespace acus::haptics
