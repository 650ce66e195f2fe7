// The loop with its threads, whose simulation stops for good in contact: its thread is halted wherever it
// stands, or a step of it fails. From there on, in ticks of the device, the force is gone within 100 ms and
// stays away. Counted are ticks, one a millisecond and never more: what a busy machine takes from the whole
// program is no time in which the device could push. ACUS_TRIALS says how often.
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/syscall.h>
#include <time.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <random>
#include <string>
#include <thread>

#include "acus/haptics/haptic_loop.h"
#include "acus/haptics/simulated_device.h"
#include "acus/haptics/virtual_coupling.h"
#include "serving.h"
#include "watched_device.h"

namespace acus::haptics {
namespace {

constexpr int allowed = 100;      // ticks
constexpr int watched = 300;      // ticks after the simulation has stopped
constexpr double noticed = 0.05;  // N: less is no force to lose

int trials() {
  const char* text = std::getenv("ACUS_TRIALS");
  return text != nullptr ? std::atoi(text) : 20;
}

// --- a thread that is halted

std::atomic<bool> halted{false}, go_on{false};
static_assert(std::atomic<bool>::is_always_lock_free, "so that a signal handler may use them");

// What SIGSTOP would do, were it not for the whole program: the thread stands where the signal met it.
void stand_still(int) {
  halted = true;
  const timespec moment{0, 1'000'000};
  while (!go_on) nanosleep(&moment, nullptr);
}

// The thread of that name; 0 while there is none.
pid_t thread_called(const std::string& name) {
  std::error_code gone;  // a thread may end while we look
  for (const auto& task : std::filesystem::directory_iterator("/proc/self/task", gone)) {
    std::string its_name;
    std::getline(std::ifstream(task.path() / "comm"), its_name);
    if (its_name == name) return static_cast<pid_t>(std::stol(task.path().filename()));
  }
  return 0;
}

// --- a session

struct Watch {
  std::atomic<bool> stopped{false};  // the simulation
  std::atomic<int> ticks{0}, since{0};
  int last_felt = 0;  // the last tick since then that had a force
  std::atomic<double> force{0.0};

  void see(const Wrench& out) {
    force = out.force.norm();
    ++ticks;
    if (!stopped) return;
    ++since;
    if (force > 0.0) last_felt = since;
  }
};

struct Stopping {
  int last_felt = 0;   // ticks from the stop of the simulation
  double force = 0.0;  // N, at the stop
  LoopReport report;
};

// A hand that pushes at `speed` [m/s] from `begin` [s] on, however far.
SimulatedDevice hand_that_pushes(double speed, double begin) {
  return {*find_device_limits("touch"), light_grip,
          [=](double t) { return std::max(speed * (t - begin), 0.0); }};
}

Simulation testing_machine() {
  Scene scene;
  scene.needle_model = NeedleModel::column;  // which folds
  scene.tissue.rigid = true;
  Result<Simulation> simulation = Simulation::build(held_by(*find_device_limits("touch"), scene));
  EXPECT_TRUE(simulation.ok());
  return std::move(simulation).value();
}

// Halts the thread of the simulation in some tick after number `from`.
Stopping halt(int from, double speed) {
  Watch watch;
  Simulation simulation = testing_machine();
  SimulatedDevice hand = hand_that_pushes(speed, 0.05);
  WatchedDevice device(hand, [&](const DeviceState&, const Wrench& out) {
    watch.stopped = halted.load();
    watch.see(out);
  });
  halted = go_on = false;
  std::atomic<bool> stop{false};
  Stopping result;
  std::thread looping([&] { result.report = run_loop(device, simulation, {}, stop).report; });
  EXPECT_TRUE(wait_for([&] { return watch.ticks >= from; }));
  const pid_t thread = thread_called(needle_thread);
  EXPECT_NE(thread, 0);
  result.force = watch.force;
  EXPECT_EQ(syscall(SYS_tgkill, getpid(), thread, SIGUSR1), 0);
  EXPECT_TRUE(wait_for([&] { return watch.since >= watched; }));
  go_on = true;
  const int seen = watch.ticks;
  EXPECT_TRUE(wait_for([&] { return watch.ticks >= seen + 50; }));  // speaks again, but the fault is latched
  stop = true;
  looping.join();
  result.last_felt = watch.last_felt;
  return result;
}

// Pushes on until the needle is bent double, where its model ends.
Stopping die(double speed) {
  Watch watch;
  Simulation simulation = testing_machine();
  SimulatedDevice hand = hand_that_pushes(speed, 0.3);
  WatchedDevice device(hand, [&](const DeviceState&, const Wrench& out) { watch.see(out); });
  Stopping result;
  LoopSettings settings;
  settings.watch = [&](const Simulation& now, const LoopStatus&) {
    if (watch.stopped || now.frame().health == Health::good) return;
    result.force = watch.force;
    watch.stopped = true;
  };
  std::atomic<bool> stop{false};
  std::thread looping([&] { result.report = run_loop(device, simulation, settings, stop).report; });
  EXPECT_TRUE(wait_for([&] { return watch.since >= watched; }));
  stop = true;
  looping.join();
  result.last_felt = watch.last_felt;
  return result;
}

// A machine that is busy may take the force before the simulation stops: that was no trial, and another takes
// its place.
template <class Trial>
void expect_force_gone_in_time(Trial trial) {
  std::mt19937 random(5);
  int felt = 0, stale = 0, longest = 0, i = 0;
  for (; felt < trials() && i < 5 * trials(); ++i) {
    const Stopping found = trial(random);
    EXPECT_LE(found.last_felt, allowed) << "trial " << i;
    EXPECT_NE(found.report.fault, GateFault::none) << "trial " << i;
    stale += found.report.fault == GateFault::stale;  // not if the whole program stood, and the hand jumped
    felt += found.force > noticed;
    longest = std::max(longest, found.last_felt);
  }
  EXPECT_EQ(felt, trials());
  EXPECT_GT(stale, trials() / 2);
  std::printf("%d trials, %d with a force to lose: gone after %d ticks at most\n", i, felt, longest);
}

double any_between(std::mt19937& random, double low, double high) {
  return low + (high - low) * (static_cast<double>(random()) / 4294967296.0);
}

TEST(StoppedSimulation, leaves_no_force_after_100_ms_when_its_thread_is_halted) {
  struct sigaction action {};
  action.sa_handler = stand_still;
  ASSERT_EQ(sigaction(SIGUSR1, &action, nullptr), 0);
  // From the midst of the ramp of arming to after it, in front of the buckling load and behind it.
  expect_force_gone_in_time([](std::mt19937& random) {
    const int from = static_cast<int>(any_between(random, 250.0, 750.0));
    return halt(from, any_between(random, 0.05, 0.3));
  });
}

TEST(StoppedSimulation, leaves_no_force_after_100_ms_when_a_step_fails) {
  expect_force_gone_in_time([](std::mt19937& random) {
    const Stopping found = die(any_between(random, 0.3, 0.7));
    EXPECT_EQ(found.report.health, Health::needle_folded);
    return found;
  });
}

}  // namespace
}  // namespace acus::haptics
