#include "acus/haptics/openhaptics.h"

#include <algorithm>
#include <cassert>
#include <chrono>
#include <thread>
#include <utility>

#include "acus/base/units.h"
#include "acus/haptics/hd_driver.h"
#include "acus/haptics/pace.h"

namespace acus::haptics {
namespace {

constexpr double patience = 0.5;                       // s, for the driver's next frame
constexpr std::chrono::milliseconds between_looks(2);  // of serve(), which is not the real-time thread
constexpr unsigned long rate = 1000;                   // Hz
constexpr double newton_per_metre = 1.0 / units::mm;   // in a N/mm
constexpr double to_millinewton_metres = 1e3;          // from N m

// What serve() and the driver's thread say to each other.
struct Exchange {
  std::atomic<long> frames{0};
  std::atomic<bool> quiet{false};     // tick is called no more, and the force is zero
  std::atomic<bool> silenced{false};  // a frame has been put out since
  std::atomic<hd::Name> error{0};
};

class OpenHaptics final : public Device {
 public:
  OpenHaptics(const hd::Driver& driver, std::string name) : driver_(driver), name_(std::move(name)) {}
  OpenHaptics(const OpenHaptics&) = delete;
  OpenHaptics& operator=(const OpenHaptics&) = delete;
  ~OpenHaptics() override { let_go(); }

  std::optional<Error> take();

  const DeviceLimits& limits() const override { return limits_; }
  std::optional<Error> serve(Tick& tick, const std::atomic<bool>& stop) override;

 private:
  std::optional<Error> start();
  std::optional<Error> watch(const std::atomic<bool>& stop);
  void finish();
  void let_go();
  void read_limits();

  static unsigned int on_frame(void* self) noexcept;
  void frame() noexcept;
  DeviceState read() const noexcept;
  void put_out(const Wrench& wrench) const noexcept;

  hd::Driver driver_;
  std::string name_;
  DeviceLimits limits_;
  hd::Handle handle_ = hd::invalid_handle;
  hd::Name gentle_calibration_ = 0;  // the style that may be renewed at any time; 0 if there is none
  hd::Schedule schedule_ = 0;
  Tick* tick_ = nullptr;
  Exchange exchange_;
};

// --- on the driver's thread: no lock, no allocation
// ---------------------------------------------------------

unsigned int OpenHaptics::on_frame(void* self) noexcept {
  static_cast<OpenHaptics*>(self)->frame();
  return hd::callback_continue;  // serve() takes it from the schedule
}

void OpenHaptics::frame() noexcept {
  const bool quiet = exchange_.quiet;
  driver_.begin_frame(handle_);
  const DeviceState state = read();
  const Wrench wanted = quiet ? Wrench{} : (*tick_)(state);
  put_out(state.ready ? wanted : Wrench{});
  driver_.end_frame(handle_);
  if (const hd::Name code = driver_.forget_errors(); code != 0 && !quiet) {
    exchange_.error = code;
    exchange_.quiet = true;
  }
  if (!state.ready && gentle_calibration_ != 0 && driver_.check_calibration() == hd::calibration_needs_update)
    driver_.update_calibration(gentle_calibration_);
  if (quiet) exchange_.silenced = true;
  ++exchange_.frames;
}

DeviceState OpenHaptics::read() const noexcept {
  std::array<double, 3> position{}, velocity{};
  std::array<double, 16> transform{};
  int buttons = 0;
  driver_.get_doublev(hd::current_position, position.data());
  driver_.get_doublev(hd::current_velocity, velocity.data());
  driver_.get_doublev(hd::current_transform, transform.data());
  driver_.get_integerv(hd::current_buttons, &buttons);
  DeviceState state;
  state.time = monotonic_time();
  state.position = Eigen::Map<const Vec3>(position.data()) * units::mm;
  state.velocity = Eigen::Map<const Vec3>(velocity.data()) * units::mm;
  state.orientation = Eigen::Map<const Eigen::Matrix4d>(transform.data()).topLeftCorner<3, 3>();
  state.buttons = static_cast<unsigned>(buttons);
  state.ready = driver_.check_calibration() == hd::calibration_ok;
  return state;
}

void OpenHaptics::put_out(const Wrench& wrench) const noexcept {
  driver_.set_doublev(hd::current_force, wrench.force.data());
  if (limits_.peak_torque <= 0.0) return;
  const Vec3 torque = wrench.torque * to_millinewton_metres;
  driver_.set_doublev(hd::current_gimbal_torque, torque.data());
}

// --- on the thread of serve()
// -------------------------------------------------------------------------------

std::optional<Error> OpenHaptics::take() {
  driver_.forget_errors();
  handle_ = driver_.init_device(name_.empty() ? nullptr : name_.c_str());
  const hd::Name code = driver_.forget_errors();
  const std::string which = name_.empty() ? "the driver's default device" : "the device '" + name_ + "'";
  if (handle_ == hd::invalid_handle || code != 0) {
    let_go();
    return Error{"OpenHaptics cannot open " + which + ": " + driver_.words_of(code) +
                 "; is it plugged in, and set up under that name with the maker's tool?"};
  }
  driver_.make_current_device(handle_);
  if (driver_.check_calibration() == hd::calibration_needs_manual_input) {
    let_go();
    return Error{which + " is not calibrated: calibrate it with the maker's tool, then try again"};
  }
  // An encoder reset is not among these: it would take the place of the handle, wherever it is, for its zero.
  int styles = 0;
  driver_.get_integerv(hd::calibration_style, &styles);
  gentle_calibration_ = static_cast<hd::Name>(styles & hd::calibrates_by_itself    ? hd::calibrates_by_itself
                                              : styles & hd::calibrates_in_inkwell ? hd::calibrates_in_inkwell
                                                                                   : 0);
  read_limits();
  return std::nullopt;
}

// The row of our table, lowered to what the driver says of the device that is plugged in.
void OpenHaptics::read_limits() {
  const char* model = driver_.get_string(hd::device_model_type);
  const bool premium = model && std::string(model).find("Premium") != std::string::npos;
  const DeviceLimits* row = find_device_limits(premium ? "premium" : "touch");
  assert(row);
  limits_ = *row;
  const auto lower = [&](double& limit, hd::Name name, double unit) {
    double said = 0.0;
    driver_.get_doublev(name, &said);
    if (said > 0.0) limit = std::min(limit, said * unit);
  };
  lower(limits_.peak_force, hd::nominal_max_force, 1.0);
  lower(limits_.continuous_force, hd::nominal_max_continuous, 1.0);
  lower(limits_.stiffness, hd::nominal_max_stiffness, newton_per_metre);
  limits_.continuous_force = std::min(limits_.continuous_force, limits_.peak_force);
  int dof = 0;
  driver_.get_integerv(hd::output_dof, &dof);
  if (dof > 0 && dof < 6) limits_.peak_torque = 0.0;
}

void OpenHaptics::let_go() {
  if (handle_ != hd::invalid_handle) driver_.disable_device(handle_);
  handle_ = hd::invalid_handle;
}

std::optional<Error> OpenHaptics::serve(Tick& tick, const std::atomic<bool>& stop) {
  if (handle_ == hd::invalid_handle)
    if (const std::optional<Error> refused = take()) return refused;
  tick_ = &tick;
  exchange_.frames = 0;
  exchange_.quiet = false;
  exchange_.silenced = false;
  exchange_.error = 0;
  std::optional<Error> lost = start();
  if (!lost) lost = watch(stop);
  finish();
  return lost;
}

std::optional<Error> OpenHaptics::start() {
  driver_.make_current_device(handle_);
  driver_.set_scheduler_rate(rate);
  driver_.forget_errors();  // a driver may keep a rate of its own, and not know all of its limits
  driver_.enable(hd::force_output);
  schedule_ = driver_.schedule_asynchronous(&on_frame, this, hd::max_priority);
  driver_.start_scheduler();
  if (const hd::Name code = driver_.forget_errors(); code != 0)
    return Error{"OpenHaptics cannot start its loop: " + driver_.words_of(code)};
  return std::nullopt;
}

std::optional<Error> OpenHaptics::watch(const std::atomic<bool>& stop) {
  long frames = 0;
  double last = monotonic_time();
  while (!stop) {
    std::this_thread::sleep_for(between_looks);
    if (const hd::Name code = exchange_.error; code != 0)
      return Error{"the device was lost: OpenHaptics reports " + driver_.words_of(code)};
    const double now = monotonic_time();
    if (const long seen = exchange_.frames; seen != frames) {
      frames = seen;
      last = now;
    } else if (now - last > patience) {
      return Error{
          "the device was lost: OpenHaptics has been silent for half a second; is it still plugged in?"};
    }
  }
  return std::nullopt;
}

// The driver's own thread puts out the zero where it still runs; else we do when it is certain to be gone.
void OpenHaptics::finish() {
  exchange_.quiet = true;
  for (const double begun = monotonic_time(); !exchange_.silenced && monotonic_time() - begun < patience;)
    std::this_thread::sleep_for(between_looks);
  driver_.unschedule(schedule_);
  driver_.stop_scheduler();
  if (!exchange_.silenced) {
    driver_.make_current_device(handle_);
    driver_.begin_frame(handle_);
    put_out(Wrench{});
    driver_.end_frame(handle_);
  }
  driver_.forget_errors();
  let_go();
}

}  // namespace

std::string openhaptics_missing() {
  const Result<hd::Driver> driver = hd::load_driver();
  return driver ? "" : driver.error().sentence;
}

Result<std::unique_ptr<Device>> open_openhaptics(const std::string& argument) {
  const Result<hd::Driver> driver = hd::load_driver();
  if (!driver) return driver.error();
  auto device = std::make_unique<OpenHaptics>(*driver, argument);
  if (const std::optional<Error> refused = device->take()) return *refused;
  return std::unique_ptr<Device>(std::move(device));
}

}  // namespace acus::haptics
