// From a hand to a needle and back, whole: the loop with its threads, a device at the other end of its real
// wire or driver, and a recording of it all. The hand pushes the 200 mm needle into contact and beyond its
// buckling load, and takes it back.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>

#include "acus/haptics/haply.h"
#include "acus/haptics/haply_emulator.h"
#include "acus/haptics/haptic_loop.h"
#include "acus/haptics/openhaptics.h"
#include "acus/haptics/stop_after.h"
#include "acus/haptics/virtual_coupling.h"
#include "acus/io/insertion.h"
#include "acus/io/replay.h"
#include "acus/needle/buckling.h"
#include "emulators/fake_hd.h"
#include "serving.h"

namespace acus::haptics {
namespace {

constexpr double start_travel = -5e-3;  // m
constexpr double duration = 6.5;        // s

Scene insertion_scene() {
  Scene scene;
  scene.needle.length = 0.2;
  scene.tissue.tetrahedra = 500;
  scene.run.time_step = 5e-3;
  return scene;
}

// One step of the replay.
struct Step {
  double travel = 0.0, force = 0.0;  // m, N
};

// What a session leaves behind, and what its replay says.
struct Session {
  LoopOutcome outcome;
  DeviceLimits limits;
  io::Recording recording;
  std::vector<Step> steps;
  std::vector<Event> events;
  bool same_bits = false;
};

Session hold_needle_with(Device& device, const std::string& name) {
  Session session;
  session.limits = device.limits();
  const std::string file = testing::TempDir() + name + ".acusrec";
  std::filesystem::remove(file);
  Result<Simulation> simulation = io::build_simulation(held_by(device.limits(), insertion_scene()));
  auto recorder = Recorder::start(file, *io::recorded_scene(simulation->scene()), "--record").value();
  LoopSettings settings;
  settings.start_travel = start_travel;
  settings.recorder = recorder.get();
  const std::atomic<bool> never{false};
  const StopAfter stop(duration, never);
  session.outcome = run_loop(device, *simulation, settings, stop.flag());
  EXPECT_FALSE(session.outcome.lost) << session.outcome.lost->sentence;
  EXPECT_FALSE(recorder->finish(simulation->state_hash()));

  session.recording = io::read_recording(file, io::Ticks::read).value();
  EXPECT_TRUE(session.recording.whole) << session.recording.loss;
  Result<Simulation> again = io::build_replay(session.recording);
  io::HashCheck check(session.recording);
  check(*again);
  session.same_bits = true;
  for (const double travel : session.recording.travels) {
    const Frame& frame = again->step(travel);
    session.same_bits = session.same_bits && check(*again);
    session.steps.push_back({travel, frame.hand_force});
  }
  session.same_bits =
      session.same_bits && check.compared() == static_cast<int>(session.recording.hashes.size());
  session.events.assign(again->events().begin(), again->events().end());
  return session;
}

Vec3 force_of(const io::RecordedTick& tick) {
  return Eigen::Map<const Eigen::Vector3f>(tick.force.data()).cast<double>();
}

// The rules of the gate, on every tick.
void expect_gated(const Session& session) {
  Vec3 before = Vec3::Zero();
  for (const io::RecordedTick& tick : session.recording.ticks) {
    const Vec3 force = force_of(tick);
    constexpr double rounding = 1e-6;  // of floats
    ASSERT_TRUE(force.allFinite());
    ASSERT_LE(force.norm(), session.limits.peak_force + rounding);
    ASSERT_LE((force - before).norm(), (force.norm() > before.norm() ? 0.5 : 1.0) + rounding);
    before = force;
  }
}

// The needle touched, bent, and came out again as it should.
void expect_insertion(const Session& session) {
  const auto has = [&](EventKind kind) {
    return std::any_of(session.events.begin(), session.events.end(),
                       [&](const Event& event) { return event.kind == kind; });
  };
  EXPECT_TRUE(has(EventKind::contact));
  EXPECT_TRUE(has(EventKind::buckling));
  EXPECT_TRUE(has(EventKind::straightening));
  const Scene scene = insertion_scene();
  const double critical = needle::critical_load(needle::bending_rigidity(scene.needle), scene.needle.length,
                                                scene.needle.support);
  double most = 0.0;
  for (const Step& step : session.steps) most = std::max(most, step.force);
  EXPECT_GT(most, 0.95 * critical);
  EXPECT_LT(most, 1.15 * critical);  // never more than the elastica carries
}

// What the device showed is what the trace says, between one step and the next: each step's travel is that of
// a tick, and there the force may differ by what the coupling's damper and the way to the next word take.
void expect_felt(const Session& session) {
  ASSERT_FALSE(session.recording.ticks.empty());
  const Vec3 origin = Vec3(session.recording.ticks.front().position.data());
  const double stiffness = coupling_for(session.limits).stiffness;
  std::vector<double> differences;
  std::size_t at = 0;
  const auto travel_of = [&](const io::RecordedTick& tick) {
    return start_travel + session.limits.forward.dot(Vec3(tick.position.data()) - origin);
  };
  for (const Step& step : session.steps) {
    std::size_t found = at;
    while (found < session.recording.ticks.size() &&
           std::abs(travel_of(session.recording.ticks[found]) - step.travel) > 1e-12)
      ++found;
    if (found == session.recording.ticks.size()) continue;  // the very first, before a tick
    at = found;
    const io::RecordedTick& tick = session.recording.ticks[at];
    const double shown = -session.limits.forward.dot(force_of(tick));
    const double speed = std::abs(
        session.limits.forward.cast<float>().dot(Eigen::Map<const Eigen::Vector3f>(tick.velocity.data())));
    const double blind = 15e-3;  // s, a step, its answer, and fading it in
    if (step.force > 0.05)
      differences.push_back(std::abs(shown - step.force) - speed * (0.3 + stiffness * blind));
  }
  ASSERT_GT(differences.size(), 100U);
  std::sort(differences.begin(), differences.end());
  EXPECT_LT(differences[differences.size() / 2], 0.02);
  EXPECT_LT(differences[differences.size() * 9 / 10], 0.1);
}

// The forces that reached the device are those that left the gate, in order, to the last bit of a float. One
// that is sent again, because an answer was late, counts once.
void expect_arrived(const std::vector<Vec3>& received, const std::vector<io::RecordedTick>& ticks) {
  std::vector<Vec3> sent{Vec3::Zero()}, arrived{Vec3::Zero()};
  for (const io::RecordedTick& tick : ticks)
    if (sent.back() != force_of(tick)) sent.push_back(force_of(tick));
  for (const Vec3& force : received)
    if (const Vec3 rounded = force.cast<float>().cast<double>(); arrived.back() != rounded)
      arrived.push_back(rounded);
  ASSERT_GT(sent.size(), 1000U);
  ASSERT_EQ(arrived.size(), sent.size());
  for (std::size_t i = 0; i < sent.size(); ++i) ASSERT_EQ(arrived[i], sent[i]) << "change " << i;
}

TEST(EndToEnd, inverse3_over_its_wire) {
  for (const haply::Dialect dialect : {haply::Dialect::values, haply::Dialect::vector}) {
    HaplyEmulatorSettings settings;
    settings.port = 0;
    settings.dialect = dialect;
    settings.plan = [](double time) {
      return std::clamp(25e-3 * (time - 1.0), 0.0, 40e-3) - std::clamp(25e-3 * (time - 3.5), 0.0, 45e-3);
    };  // m
    const auto emulator = HaplyEmulator::start(std::move(settings)).value();
    const auto device = open_haply(std::to_string(emulator->port())).value();
    const Session session = hold_needle_with(*device, "inverse3");
    EXPECT_TRUE(session.same_bits);
    expect_gated(session);
    expect_insertion(session);
    expect_felt(session);
    std::vector<Vec3> received;
    for (const HaplyCommand& command : emulator->commands()) received.push_back(command.force);
    expect_arrived(received, session.recording.ticks);
  }
}

TEST(EndToEnd, phantom_through_the_library_of_its_driver) {
  const std::string library = ACUS_BUILD_DIR "/emulators/libHD.so";
  setenv("ACUS_LIBHD", library.c_str(), 1);
  setenv("ACUS_EMULATED_HAND", "1", 1);
  emulator_function<decltype(fake_hd_reset)>(library, "fake_hd_reset")();
  const auto device = open_openhaptics("").value();
  const Session session = hold_needle_with(*device, "phantom");
  EXPECT_TRUE(session.same_bits);
  expect_gated(session);
  expect_insertion(session);
  expect_felt(session);
  std::vector<std::array<double, 3>> history(20'000);
  const long frames = emulator_function<decltype(fake_hd_history)>(library, "fake_hd_history")(
      reinterpret_cast<double(*)[3]>(history.data()), static_cast<long>(history.size()));
  std::vector<Vec3> received;
  for (long i = 0; i < frames; ++i) received.emplace_back(history[static_cast<std::size_t>(i)].data());
  expect_arrived(received, session.recording.ticks);
}

}  // namespace
}  // namespace acus::haptics
