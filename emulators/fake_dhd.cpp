// An emulator of Force Dimension's libdhd.so: the interface as its manual describes it, and a hand
// made of a mass and a spring that moves on by a millisecond with every force. No code of the maker's, and no
// proof about it.
#include "fake_dhd.h"

#include <cstring>
#include <mutex>

#include "fake_hand.h"

namespace {

constexpr char device_id = 2;
constexpr int time_guard = 1;  // "as fresh as can be": no error

struct Fake {
  FakeDhdReport report{};
  FakeHand hand;
  FakeDhdFailure failure = fake_dhd_nothing;
  bool calibrated = true, posed = false;
  double position[3] = {}, velocity[3] = {};
  double frame[9] = {1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0};
  int button = 0;
};

Fake fake;
std::mutex guard;  // of `fake`
using Lock = std::lock_guard<std::mutex>;

bool answers(char id) { return id == device_id && fake.report.open && fake.failure != fake_dhd_everything; }

int tell(const double* values, double* x, double* y, double* z) {
  *x = values[0];
  *y = values[1];
  *z = values[2];
  return time_guard;
}

}  // namespace

extern "C" {

int dhdOpenID(char index) {
  const Lock lock(guard);
  if (fake.failure == fake_dhd_open_fails) return -1;
  fake.hand.wake_up({-1.0, 0.0, 0.0});
  fake.report.index = index;
  fake.report.open = true;
  return device_id;
}

int dhdClose(char id) {
  const Lock lock(guard);
  if (id != device_id) return -1;
  fake.report.open = false;
  fake.report.force_enabled = false;
  return 0;
}

int dhdGetPosition(double* x, double* y, double* z, char id) {
  const Lock lock(guard);
  if (!answers(id) || fake.failure == fake_dhd_read_fails) return -1;
  return tell(fake.posed ? fake.position : fake.hand.position.data(), x, y, z);
}

int dhdGetLinearVelocity(double* x, double* y, double* z, char id) {
  const Lock lock(guard);
  if (!answers(id)) return -1;
  return tell(fake.posed ? fake.velocity : fake.hand.velocity.data(), x, y, z);
}

int dhdGetOrientationFrame(double frame[3][3], char id) {
  const Lock lock(guard);
  if (!answers(id)) return -1;
  std::memcpy(frame, fake.frame, sizeof fake.frame);
  return time_guard;
}

int dhdGetButton(int index, char id) {
  const Lock lock(guard);
  return answers(id) && index == 0 ? fake.button : -1;
}

int dhdGetStatus(int* status, char id) {
  const Lock lock(guard);
  if (!answers(id)) return -1;
  constexpr int calibrated = 3;
  for (int i = 0; i < 17; ++i) status[i] = i == calibrated ? fake.calibrated : !fake.calibrated;
  return 0;
}

int dhdSetForce(double x, double y, double z, char id) {
  const Lock lock(guard);
  if (!answers(id)) return -1;
  if (fake.failure == fake_dhd_force_fails && (x != 0.0 || y != 0.0 || z != 0.0)) return -1;
  const FakeHand::Triple force = {x, y, z};
  std::memcpy(fake.report.force, force.data(), sizeof fake.report.force);
  ++fake.report.forces;
  fake.hand.move(fake.report.force_enabled ? force : FakeHand::Triple{}, 1e-3);
  return 0;
}

int dhdEnableForce(unsigned char on, char id) {
  const Lock lock(guard);
  if (!answers(id)) return -1;
  fake.report.force_enabled = on != 0;
  return 0;
}

int dhdSetWatchdog(unsigned char eighths, char id) {
  const Lock lock(guard);
  if (!answers(id)) return -1;
  fake.report.watchdog = eighths;
  return 0;
}

const char* dhdErrorGetLastStr() { return "communication error"; }

// --- for tests
// ----------------------------------------------------------------------------------------------

void fake_dhd_reset() {
  const Lock lock(guard);
  fake = Fake();
}

void fake_dhd_report(FakeDhdReport* report) {
  const Lock lock(guard);
  *report = fake.report;
  std::memcpy(report->position, fake.hand.position.data(), sizeof report->position);
}

void fake_dhd_fail(FakeDhdFailure failure) {
  const Lock lock(guard);
  fake.failure = failure;
}

void fake_dhd_calibrate(bool calibrated) {
  const Lock lock(guard);
  fake.calibrated = calibrated;
}

void fake_dhd_pose(const double* position, const double* velocity, const double* frame, int button) {
  const Lock lock(guard);
  std::memcpy(fake.position, position, sizeof fake.position);
  std::memcpy(fake.velocity, velocity, sizeof fake.velocity);
  std::memcpy(fake.frame, frame, sizeof fake.frame);
  fake.button = button;
  fake.posed = true;
}

void fake_dhd_send_hand(double stiffness, double x, double y, double z) {
  const Lock lock(guard);
  fake.hand.stiffness = stiffness;
  fake.hand.goal = {x, y, z};
}
}
