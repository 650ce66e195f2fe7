// An emulator of OpenHaptics' libHD.so: the interface as its manual describes it, a scheduler with
// a thread of its own, and a hand made of a mass and a spring. No code of the maker's, and no proof about it.
#include "fake_hd.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstring>
#include <deque>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "fake_hand.h"

namespace {

using Callback = unsigned int (*)(void*);

constexpr unsigned int device_handle = 7, no_handle = 0xFFFFFFFF;
constexpr unsigned long schedule_handle = 3;
constexpr unsigned int invalid_enum = 0x0100, invalid_operation = 0x0102, bad_handle = 0x0104,
                       device_fault = 0x0300, timer_error = 0x0304, illegal_begin = 0x0400,
                       illegal_end = 0x0401, frame_error = 0x0402;

struct Pose {
  double position[3], velocity[3], transform[16];
  int buttons;
};

struct Fake {
  FakeHdSetup setup;
  std::string model = "Touch";
  FakeHdReport report{};
  FakeHand hand;
  Pose pose{};
  bool posed = false, in_frame = false, unplugged = false;
  double next_force[3] = {}, next_torque[3] = {};
  unsigned int raise = 0;
  std::deque<unsigned int> errors;
  std::vector<FakeHand::Triple> history;  // N, of the frames that ended
  Callback callback = nullptr;
  void* user_data = nullptr;
};

Fake fake;
std::mutex guard;    // of `fake`
std::mutex calling;  // held while a callback runs: hdUnschedule waits for it
std::thread scheduler;
std::atomic<bool> scheduler_stops{false};

using Lock = std::lock_guard<std::mutex>;

void schedule() {
  auto due = std::chrono::steady_clock::now();
  while (!scheduler_stops) {
    due = std::max(due + std::chrono::milliseconds(1), std::chrono::steady_clock::now());
    std::this_thread::sleep_until(due);
    const Lock call(calling);
    Callback callback = nullptr;
    void* user_data = nullptr;
    {
      const Lock lock(guard);
      if (!fake.unplugged) callback = fake.callback;
      user_data = fake.user_data;
    }
    if (!callback || callback(user_data) == 1) continue;
    const Lock lock(guard);
    fake.callback = nullptr;
  }
}

void stop_scheduler() {
  scheduler_stops = true;
  if (scheduler.joinable()) scheduler.join();
}

// A state of the device may be read within a frame only.
bool readable() {
  if (!fake.in_frame) fake.errors.push_back(frame_error);
  return fake.in_frame;
}

void tell(double value, double* out) {
  if (value < 0.0) return fake.errors.push_back(invalid_enum);
  *out = value;
}

// Lengths in the driver's units.
void tell_millimetres(const FakeHand::Triple& metres, double* out) {
  if (!readable()) return;
  for (std::size_t i = 0; i < 3; ++i) out[i] = 1000.0 * metres[i];
}

void tell_transform(double* out) {
  if (!readable()) return;
  if (fake.posed) {
    std::memcpy(out, fake.pose.transform, sizeof fake.pose.transform);
    return;
  }
  for (int i = 0; i < 16; ++i) out[i] = i % 5 == 0 ? 1.0 : 0.0;
  for (std::size_t i = 0; i < 3; ++i) out[12 + i] = 1000.0 * fake.hand.position[i];
}

}  // namespace

extern "C" {

struct HDErrorInfo {
  unsigned int code;
  int internal_code;
  unsigned int device;
};

unsigned int hdInitDevice(const char* name) {
  const Lock lock(guard);
  if (fake.setup.refuses) {
    fake.errors.push_back(device_fault);
    return no_handle;
  }
  fake.report.default_name = name == nullptr;
  std::strncpy(fake.report.name, name ? name : "", sizeof fake.report.name - 1);
  fake.report.open = true;
  ++fake.report.opened;
  fake.hand.wake_up({0.0, 0.0, -1.0});
  return device_handle;
}

void hdDisableDevice(unsigned int device) {
  const Lock lock(guard);
  if (device != device_handle || !fake.report.open) fake.errors.push_back(bad_handle);
  fake.report.open = false;
  fake.report.force_enabled = false;
}

void hdMakeCurrentDevice(unsigned int device) {
  const Lock lock(guard);
  if (device != device_handle) fake.errors.push_back(bad_handle);
}

void hdBeginFrame(unsigned int device) {
  const Lock lock(guard);
  if (device != device_handle || !fake.report.open || fake.in_frame) fake.errors.push_back(illegal_begin);
  fake.in_frame = true;
}

void hdEndFrame(unsigned int device) {
  const Lock lock(guard);
  if (device != device_handle || !fake.in_frame) fake.errors.push_back(illegal_end);
  fake.in_frame = false;
  ++fake.report.frames;
  std::memcpy(fake.report.force, fake.next_force, sizeof fake.next_force);
  std::memcpy(fake.report.torque, fake.next_torque, sizeof fake.next_torque);
  constexpr std::size_t longest = 100'000;
  if (fake.history.size() < longest)
    fake.history.push_back({fake.next_force[0], fake.next_force[1], fake.next_force[2]});
  FakeHand::Triple felt{};
  if (fake.report.force_enabled) std::memcpy(felt.data(), fake.next_force, sizeof fake.next_force);
  fake.hand.move(felt, 1e-3);
  if (fake.raise != 0) fake.errors.push_back(fake.raise);
  fake.raise = 0;
}

HDErrorInfo hdGetError() {
  const Lock lock(guard);
  if (fake.errors.empty()) return {0, 0, no_handle};
  const unsigned int code = fake.errors.front();
  fake.errors.pop_front();
  return {code, 0, device_handle};
}

const char* hdGetErrorString(unsigned int code) {
  return code == 0x0302 ? "HD_COMM_ERROR" : code == device_fault ? "HD_DEVICE_FAULT" : nullptr;
}

void hdEnable(unsigned int capability) {
  const Lock lock(guard);
  if (capability != 0x4000) return fake.errors.push_back(invalid_enum);
  fake.report.force_enabled = true;
}

void hdGetDoublev(unsigned int name, double* out) {
  const Lock lock(guard);
  switch (name) {
    case 0x2050:
      if (fake.posed && readable()) std::memcpy(out, fake.pose.position, sizeof fake.pose.position);
      if (!fake.posed) tell_millimetres(fake.hand.position, out);
      return;
    case 0x2051:
      if (fake.posed && readable()) std::memcpy(out, fake.pose.velocity, sizeof fake.pose.velocity);
      if (!fake.posed) tell_millimetres(fake.hand.velocity, out);
      return;
    case 0x2052:
      return tell_transform(out);
    case 0x2602:
      return tell(fake.setup.max_stiffness, out);
    case 0x2603:
      return tell(fake.setup.max_force, out);
    case 0x2604:
      return tell(fake.setup.max_continuous, out);
    default:
      return fake.errors.push_back(invalid_enum);
  }
}

void hdSetDoublev(unsigned int name, const double* values) {
  const Lock lock(guard);
  if (!fake.in_frame) return fake.errors.push_back(frame_error);
  if (name == 0x2700) {
    std::memcpy(fake.next_force, values, sizeof fake.next_force);
  } else if (name == 0x2704 && fake.setup.output_dof == 6) {
    std::memcpy(fake.next_torque, values, sizeof fake.next_torque);
    ++fake.report.torques;
  } else {
    fake.errors.push_back(invalid_enum);
  }
}

void hdGetIntegerv(unsigned int name, int* out) {
  const Lock lock(guard);
  if (name == 0x2000 && readable()) {
    *out = fake.pose.buttons;
  } else if (name == 0x2554) {
    *out = fake.setup.output_dof;
  } else if (name == 0x2555) {
    *out = fake.setup.calibration_styles;
  } else if (name != 0x2000) {
    fake.errors.push_back(invalid_enum);
  }
}

const char* hdGetString(unsigned int name) {
  const Lock lock(guard);
  if (name == 0x2501) return fake.model.c_str();
  fake.errors.push_back(invalid_enum);
  return nullptr;
}

unsigned int hdCheckCalibration() {
  const Lock lock(guard);
  return fake.setup.calibration;
}

void hdUpdateCalibration(unsigned int style) {
  const Lock lock(guard);
  if (fake.in_frame || !(style & static_cast<unsigned>(fake.setup.calibration_styles)))
    return fake.errors.push_back(invalid_operation);
  fake.setup.calibration = 0x5000;
}

unsigned long hdScheduleAsynchronous(Callback callback, void* user_data, unsigned short) {
  const Lock lock(guard);
  fake.callback = callback;
  fake.user_data = user_data;
  return schedule_handle;
}

void hdUnschedule(unsigned long schedule) {
  const Lock call(calling);
  const Lock lock(guard);
  if (schedule != schedule_handle || !fake.callback) fake.errors.push_back(bad_handle);
  fake.callback = nullptr;
}

void hdStartScheduler() {
  if (scheduler.joinable()) return;
  const Lock lock(guard);
  if (!fake.setup.starts) return fake.errors.push_back(timer_error);
  scheduler_stops = false;
  scheduler = std::thread(schedule);
}

void hdStopScheduler() { stop_scheduler(); }

void hdSetSchedulerRate(unsigned long rate) {
  const Lock lock(guard);
  fake.report.rate = rate;
}

// --- for tests
// ----------------------------------------------------------------------------------------------

void fake_hd_reset() {
  stop_scheduler();
  const Lock lock(guard);
  fake = Fake();
}

void fake_hd_setup(const FakeHdSetup* setup) {
  const Lock lock(guard);
  fake.setup = *setup;
  fake.model = setup->model;
}

void fake_hd_report(FakeHdReport* report) {
  const Lock lock(guard);
  *report = fake.report;
  for (std::size_t i = 0; i < 3; ++i) report->position[i] = fake.hand.position[i];
  report->scheduled = fake.callback != nullptr;
  report->scheduler_runs = scheduler.joinable();
}

long fake_hd_history(double (*forces)[3], long most) {
  const Lock lock(guard);
  const long count = std::min(most, static_cast<long>(fake.history.size()));
  for (long i = 0; i < count; ++i)
    std::memcpy(forces[i], fake.history[static_cast<std::size_t>(i)].data(), sizeof forces[i]);
  return count;
}

void fake_hd_pose(const double* position, const double* velocity, const double* transform, int buttons) {
  const Lock lock(guard);
  std::memcpy(fake.pose.position, position, sizeof fake.pose.position);
  std::memcpy(fake.pose.velocity, velocity, sizeof fake.pose.velocity);
  std::memcpy(fake.pose.transform, transform, sizeof fake.pose.transform);
  fake.pose.buttons = buttons;
  fake.posed = true;
}

void fake_hd_send_hand(double stiffness, double x, double y, double z) {
  const Lock lock(guard);
  fake.hand.stiffness = stiffness;
  fake.hand.goal = {x, y, z};
}

void fake_hd_raise(unsigned int error) {
  const Lock lock(guard);
  fake.raise = error;
}

void fake_hd_unplug() {
  const Lock lock(guard);
  fake.unplugged = true;
}
}
