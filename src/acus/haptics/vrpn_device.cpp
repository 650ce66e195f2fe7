#include "acus/haptics/vrpn_device.h"

#include <algorithm>
#include <utility>

#include "acus/haptics/pace.h"
#include "acus/haptics/vrpn_address.h"

#define VRPN_CLIENT_ONLY
#include <vrpn_Button.h>
#include <vrpn_Connection.h>
#include <vrpn_ForceDevice.h>
#include <vrpn_Tracker.h>

namespace acus::haptics {
namespace {

constexpr double patience = 0.5;             // s: a server that is silent for longer is lost
constexpr double still = 50e-3;              // s: a tracker that is silent for longer is not ready
constexpr double opening_patience = 2.0;     // s, for each of the two steps of opening
constexpr suseconds_t between_looks = 1000;  // us, where nothing arrives
// m: a force that is not renewed ends where the hand leaves its field, at 1.2 m/s after `still`.
constexpr vrpn_float32 reach = 60e-3F;

struct GivesBack {
  void operator()(vrpn_Connection* connection) const { connection->removeReference(); }
};
using Connection = std::unique_ptr<vrpn_Connection, GivesBack>;

// Ordered and without a port of our own: no force can arrive after the zero that ends a session.
Connection connect_to(const VrpnAddress& address) {
  return Connection(vrpn_get_connection_by_name(("tcp://" + server_of(address)).c_str(), nullptr, nullptr,
                                                nullptr, nullptr, nullptr, true));
}

// A server does not say what it serves: so of each quantity the most delicate that we know. The axes are
// those of a Phantom.
DeviceLimits most_cautious() {
  DeviceLimits limits = known_devices().front();
  for (const DeviceLimits& row : known_devices()) {
    limits.peak_force = std::min(limits.peak_force, row.peak_force);
    limits.continuous_force = std::min(limits.continuous_force, row.continuous_force);
    limits.stiffness = std::min(limits.stiffness, row.stiffness);
    limits.mass = std::min(limits.mass, row.mass);
    limits.viscous = std::min(limits.viscous, row.viscous);
    limits.coulomb = std::min(limits.coulomb, row.coulomb);
    limits.quantum = std::max(limits.quantum, row.quantum);
    limits.delay = std::max(limits.delay, row.delay);
  }
  limits.peak_torque = 0.0;  // a force field has none
  limits.forward = Vec3(0.0, 0.0, -1.0);
  limits.source = "of each quantity the most delicate in devices.toml";
  return limits;
}

class VrpnDevice final : public Device {
 public:
  explicit VrpnDevice(const VrpnAddress& address);
  VrpnDevice(const VrpnDevice&) = delete;
  VrpnDevice& operator=(const VrpnDevice&) = delete;

  // Waits until the server says where the handle is.
  std::optional<Error> take();

  const DeviceLimits& limits() const override { return limits_; }
  std::optional<Error> serve(Tick& tick, const std::atomic<bool>& stop) override;

 private:
  static void VRPN_CALLBACK on_position(void* self, vrpn_TRACKERCB report);
  static void VRPN_CALLBACK on_velocity(void* self, vrpn_TRACKERVELCB report);
  static void VRPN_CALLBACK on_button(void* self, vrpn_BUTTONCB report);
  static void VRPN_CALLBACK on_buttons(void* self, vrpn_BUTTONSTATESCB report);

  void hear(const vrpn_TRACKERCB& report) noexcept;
  void set_button(int button, bool down) noexcept;
  void look();
  std::optional<Error> run(const std::atomic<bool>& stop);
  void answer() noexcept;
  void let_go();

  VrpnAddress address_;
  DeviceLimits limits_;
  Connection connection_;
  vrpn_Tracker_Remote tracker_;
  vrpn_Button_Remote button_;
  vrpn_ForceDevice_Remote force_;
  Tick* tick_ = nullptr;
  DeviceState state_;               // as last reported
  double heard_ = -1.0;             // s, of our clock, when; negative: never
  double reported_ = 0.0;           // s, of the server's clock, when
  double velocity_heard_ = -still;  // s, of our clock
};

VrpnDevice::VrpnDevice(const VrpnAddress& address)
    : address_(address),
      connection_(connect_to(address)),
      tracker_(address.name.c_str(), connection_.get()),
      button_(address.name.c_str(), connection_.get()),
      force_(address.name.c_str(), connection_.get()) {
  limits_ = most_cautious();
  limits_.name = "vrpn";
  limits_.title = "the device " + address.name + " of the VRPN server " + server_of(address);
  tracker_.register_change_handler(this, on_position, 0);
  tracker_.register_change_handler(this, on_velocity, 0);
  button_.register_change_handler(this, on_button);
  button_.register_states_handler(this, on_buttons);
}

// --- what the server says

void VrpnDevice::on_position(void* self, const vrpn_TRACKERCB report) {
  static_cast<VrpnDevice*>(self)->hear(report);
}

void VrpnDevice::on_velocity(void* self, const vrpn_TRACKERVELCB report) {
  auto& device = *static_cast<VrpnDevice*>(self);
  device.state_.velocity = Vec3(report.vel);
  device.velocity_heard_ = monotonic_time();
}

void VrpnDevice::on_button(void* self, const vrpn_BUTTONCB report) {
  static_cast<VrpnDevice*>(self)->set_button(report.button, report.state != 0);
}

void VrpnDevice::on_buttons(void* self, const vrpn_BUTTONSTATESCB report) {
  for (int i = 0; i < report.num_buttons; ++i)
    static_cast<VrpnDevice*>(self)->set_button(i, report.states[i] != 0);
}

void VrpnDevice::set_button(int button, bool down) noexcept {
  constexpr int most = 32;
  if (button < 0 || button >= most) return;
  const unsigned bit = 1U << static_cast<unsigned>(button);
  state_.buttons = down ? state_.buttons | bit : state_.buttons & ~bit;
}

void VrpnDevice::hear(const vrpn_TRACKERCB& report) noexcept {
  const Vec3 position(report.pos);
  const double now = monotonic_time();
  const double reported =
      static_cast<double>(report.msg_time.tv_sec) + 1e-6 * static_cast<double>(report.msg_time.tv_usec);
  if (now - velocity_heard_ > still) {  // the server says none: from the places, by its own clock
    const double elapsed = reported - reported_;
    state_.velocity =
        heard_ >= 0.0 && elapsed > 0.0 ? Vec3((position - state_.position) / elapsed) : Vec3(Vec3::Zero());
  }
  const Eigen::Quaterniond turn(report.quat[3], report.quat[0], report.quat[1], report.quat[2]);
  state_.orientation =
      turn.norm() > 0.0 ? Mat3(turn.normalized().toRotationMatrix()) : Mat3(Mat3::Identity());
  state_.position = position;
  state_.time = heard_ = now;
  state_.ready = true;
  reported_ = reported;
  answer();
}

// --- what is said to it

void VrpnDevice::answer() noexcept {
  if (!tick_) return;
  const Vec3 wanted = (*tick_)(state_).force;
  const Eigen::Vector3f force = (state_.ready ? wanted : Vec3(Vec3::Zero())).cast<float>();
  const Eigen::Vector3f origin = state_.position.cast<float>();
  force_.setFF_Origin(origin.x(), origin.y(), origin.z());
  force_.setFF_Force(force.x(), force.y(), force.z());
  force_.setFF_Jacobian(0, 0, 0, 0, 0, 0, 0, 0, 0);  // every report is answered, so none is needed
  force_.setFF_Radius(reach);
  force_.sendForceField();
}

void VrpnDevice::look() {
  const timeval longest{0, between_looks};
  connection_->mainloop(&longest);
  connection_->send_pending_reports();
}

std::optional<Error> VrpnDevice::take() {
  const double begun = monotonic_time();
  while (heard_ < 0.0 && monotonic_time() - begun < opening_patience) look();
  if (heard_ >= 0.0) return std::nullopt;
  if (!connection_->connected())
    return Error{"what answers at " + server_of(address_) + " is no VRPN server"};
  return Error{"the VRPN server at " + server_of(address_) + " does not say where a tracker '" +
               address_.name + "' is: is that its name in vrpn.cfg, and is the device switched on?"};
}

std::optional<Error> VrpnDevice::serve(Tick& tick, const std::atomic<bool>& stop) {
  tick_ = &tick;
  heard_ = monotonic_time();
  std::optional<Error> lost = run(stop);
  tick_ = nullptr;
  let_go();
  return lost;
}

std::optional<Error> VrpnDevice::run(const std::atomic<bool>& stop) {
  while (!stop) {
    look();
    if (!connection_->connected())
      return Error{"the device was lost: the VRPN server at " + server_of(address_) +
                   " has closed the connection; is it still running?"};
    const double now = monotonic_time();
    if (now - heard_ > patience)
      return Error{
          "the device was lost: its tracker has been silent for half a second; is the VRPN server at " +
          server_of(address_) + " still running?"};
    if (now - heard_ > still) {  // so that the force goes, and comes back as at the start
      state_.time = now;
      state_.ready = false;
      answer();
    }
  }
  return std::nullopt;
}

void VrpnDevice::let_go() {
  force_.stopForceField();
  connection_->send_pending_reports();
}

}  // namespace

std::string vrpn_missing() { return ""; }

Result<std::unique_ptr<Device>> open_vrpn(const std::string& argument) {
  const Result<VrpnAddress> address = parse_vrpn_address(argument);
  if (!address) return address.error();
  if (const std::optional<Error> refused = unreachable(*address, opening_patience)) return *refused;
  auto device = std::make_unique<VrpnDevice>(*address);
  if (const std::optional<Error> refused = device->take()) return *refused;
  return std::unique_ptr<Device>(std::move(device));
}

}  // namespace acus::haptics
