#include "acus/haptics/force_dimension.h"

#include <array>
#include <cassert>
#include <utility>

#include "acus/haptics/pace.h"
#include "acus/haptics/shared_library.h"

namespace acus::haptics {
namespace {

constexpr double period = 1e-3;  // s

// The functions of libdhd that we use. A result below 0 is an error; 0 and 1 (a value as fresh as the device
// can give) are not.
struct DhdDriver {
  int (*open_id)(char index);
  int (*close)(char id);
  int (*get_position)(double* x, double* y, double* z, char id);         // m
  int (*get_linear_velocity)(double* x, double* y, double* z, char id);  // m/s
  int (*get_orientation_frame)(double frame[3][3], char id);             // by rows
  int (*get_button)(int index, char id);
  int (*get_status)(int* status, char id);
  int (*set_force)(double x, double y, double z, char id);  // N
  int (*enable_force)(unsigned char on, char id);
  int (*set_watchdog)(unsigned char eighths, char id);  // of a ms
  const char* (*error_get_last_str)();                  // null in old libraries
};

constexpr std::size_t status_room = 64;       // more than any version of the library fills: 13 to 17
constexpr std::size_t status_calibrated = 3;  // its index among them
// Without a new force for this long the device itself lets go, should this program die.
constexpr unsigned char watchdog = 160;  // eighths of a ms: 20 ms

Result<DhdDriver> load_dhd() {
  static constexpr std::array names = {"libdhd.so", "libdhd.so.3"};
  Result<SharedLibrary> library = SharedLibrary::open(
      {"ACUS_LIBDHD", names, "Force Dimension's devices", "install the Force Dimension SDK"});
  if (!library) return library.error();
  DhdDriver driver{};
  library->require(driver.open_id, "dhdOpenID");
  library->require(driver.close, "dhdClose");
  library->require(driver.get_position, "dhdGetPosition");
  library->require(driver.get_linear_velocity, "dhdGetLinearVelocity");
  library->require(driver.get_orientation_frame, "dhdGetOrientationFrame");
  library->require(driver.get_button, "dhdGetButton");
  library->require(driver.get_status, "dhdGetStatus");
  library->require(driver.set_force, "dhdSetForce");
  library->require(driver.enable_force, "dhdEnableForce");
  library->require(driver.set_watchdog, "dhdSetWatchdog");
  library->find(driver.error_get_last_str, "dhdErrorGetLastStr");
  if (const std::optional<Error> missing = library->complaint()) return *missing;
  return driver;
}

std::string words_of_last_error(const DhdDriver& driver) {
  const char* words = driver.error_get_last_str ? driver.error_get_last_str() : nullptr;
  return words ? words : "no reason given";
}

class ForceDimension final : public Device {
 public:
  ForceDimension(const DhdDriver& driver, char id) : driver_(driver), id_(id) {
    const DeviceLimits* row = find_device_limits("omega");
    assert(row);
    limits_ = *row;
  }
  ForceDimension(const ForceDimension&) = delete;
  ForceDimension& operator=(const ForceDimension&) = delete;
  ~ForceDimension() override { driver_.close(id_); }

  const DeviceLimits& limits() const override { return limits_; }

  std::optional<Error> serve(Tick& tick, const std::atomic<bool>& stop) override {
    driver_.set_watchdog(watchdog, id_);  // where the device has one
    std::optional<Error> lost;
    calibrated_ = false;
    if (driver_.enable_force(1, id_) < 0) lost = failure("switch its force on");
    if (!lost) lost = run(tick, stop);
    driver_.set_force(0.0, 0.0, 0.0, id_);
    driver_.enable_force(0, id_);
    return lost;
  }

 private:
  std::optional<Error> run(Tick& tick, const std::atomic<bool>& stop) {
    Pace pace(period);
    for (; !stop; pace.wait()) {
      DeviceState state;
      if (!read(state)) return failure("say where it is");
      const Vec3 wanted = tick(state).force;
      const Vec3 force = state.ready ? wanted : Vec3(Vec3::Zero());
      if (driver_.set_force(force.x(), force.y(), force.z(), id_) < 0) return failure("take a force");
    }
    return std::nullopt;
  }

  bool read(DeviceState& state) noexcept {
    state.time = monotonic_time();
    Vec3& x = state.position;
    Vec3& v = state.velocity;
    double frame[3][3] = {{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}};
    if (driver_.get_position(&x[0], &x[1], &x[2], id_) < 0) return false;
    if (driver_.get_linear_velocity(&v[0], &v[1], &v[2], id_) < 0) return false;
    if (driver_.get_orientation_frame(frame, id_) < 0) return false;
    for (int row = 0; row < 3; ++row)
      for (int column = 0; column < 3; ++column) state.orientation(row, column) = frame[row][column];
    state.buttons = driver_.get_button(0, id_) > 0 ? 1 : 0;
    if (!calibrated_) {  // stays so once it is, and to ask takes time on the wire
      std::array<int, status_room> status{};
      if (driver_.get_status(status.data(), id_) < 0) return false;
      calibrated_ = status[status_calibrated] != 0;
    }
    state.ready = calibrated_;
    return true;
  }

  Error failure(const char* what) const {
    return Error{"the device was lost: it did not " + std::string(what) + " (" +
                 words_of_last_error(driver_) + "); is it still plugged in and switched on?"};
  }

  DhdDriver driver_;
  DeviceLimits limits_;
  char id_;
  bool calibrated_ = false;
};

}  // namespace

std::string force_dimension_missing() {
  const Result<DhdDriver> driver = load_dhd();
  return driver ? "" : driver.error().sentence;
}

Result<std::unique_ptr<Device>> open_force_dimension(const std::string& argument) {
  const bool digit = argument.size() == 1 && argument[0] >= '0' && argument[0] <= '9';
  if (!argument.empty() && !digit)
    return Error{"'" + argument +
                 "' is no number of a Force Dimension device: give 0 for the first, up to 9"};
  const Result<DhdDriver> driver = load_dhd();
  if (!driver) return driver.error();
  const int id = driver->open_id(static_cast<char>(digit ? argument[0] - '0' : 0));
  if (id < 0)
    return Error{"no Force Dimension device can be opened (" + words_of_last_error(*driver) +
                 "): is it plugged in, switched on, and are you allowed to use it?"};
  return std::unique_ptr<Device>(std::make_unique<ForceDimension>(*driver, static_cast<char>(id)));
}

}  // namespace acus::haptics
