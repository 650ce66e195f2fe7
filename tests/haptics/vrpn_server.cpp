#include "vrpn_server.h"

#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>

#define VRPN_CLIENT_ONLY
#include <vrpn_Button.h>
#include <vrpn_Connection.h>
#include <vrpn_ForceDevice.h>
#include <vrpn_Shared.h>
#include <vrpn_Tracker.h>

// VRPN's own: an endpoint forgets the address of its interface.
extern "C" const char* __lsan_default_suppressions();
const char* __lsan_default_suppressions() { return "leak:vrpn_Endpoint_IP::setNICaddress"; }

namespace {

constexpr double period = 1e-3;  // s

// One that nobody listens at now.
int free_port() {
  const int asking = socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in at{};
  at.sin_family = AF_INET;
  at.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof at;
  bind(asking, reinterpret_cast<sockaddr*>(&at), size);
  getsockname(asking, reinterpret_cast<sockaddr*>(&at), &size);
  close(asking);
  return ntohs(at.sin_port);
}

class Buttons final : public vrpn_Button_Filter {
 public:
  Buttons(const char* name, vrpn_Connection* connection) : vrpn_Button_Filter(name, connection) {
    num_buttons = 2;
  }
  void mainloop() override {
    server_mainloop();
    vrpn_gettimeofday(&timestamp, nullptr);
    report_changes();
  }
  void set(unsigned down) {
    for (int i = 0; i < num_buttons; ++i) buttons[i] = (down >> i & 1U) != 0 ? 1 : 0;
  }
};

class Forces final : public vrpn_ForceDevice {
 public:
  Forces(const char* name, vrpn_Connection* connection) : vrpn_ForceDevice(name, connection) {
    register_autodeleted_handler(forcefield_message_id, on_field, this, d_sender_id);
  }
  void mainloop() override { server_mainloop(); }
  std::vector<ForceField> heard;

 private:
  static int VRPN_CALLBACK on_field(void* self, vrpn_HANDLERPARAM message) {
    ForceField field;
    vrpn_float32 jacobian[3][3];
    if (decode_forcefield(message.buffer, message.payload_len, field.origin.data(), field.force.data(),
                          jacobian, &field.radius) != 0)
      return -1;
    std::copy_n(&jacobian[0][0], field.jacobian.size(), field.jacobian.begin());
    static_cast<Forces*>(self)->heard.push_back(field);
    return 0;
  }
};

}  // namespace

struct VrpnServer::Parts {
  Parts(const char* name, vrpn_Connection* connection)
      : tracker(name, connection), buttons(name, connection), forces(name, connection) {}
  vrpn_Tracker_Server tracker;
  Buttons buttons;
  Forces forces;
};

VrpnServer::VrpnServer(const std::string& name)
    : name_(name), port_(free_port()), thread_([this] { run(); }) {
  while (!running_) std::this_thread::yield();
}

VrpnServer::~VrpnServer() { stop(); }

void VrpnServer::stop() {
  stopping_ = true;
  if (thread_.joinable()) thread_.join();
}

std::string VrpnServer::address() const { return name_ + "@127.0.0.1:" + std::to_string(port_); }

void VrpnServer::run() {
  vrpn_Connection* connection = vrpn_create_server_connection(port_, nullptr, nullptr, "127.0.0.1");
  {
    Parts parts(name_.c_str(), connection);
    running_ = true;
    for (; !stopping_; std::this_thread::sleep_for(std::chrono::milliseconds(1))) {
      report(parts);
      parts.tracker.mainloop();
      parts.buttons.mainloop();
      parts.forces.mainloop();
      connection->mainloop();
    }
  }
  connection->removeReference();
}

void VrpnServer::report(Parts& parts) {
  const std::lock_guard lock(guard_);
  fields_.insert(fields_.end(), parts.forces.heard.begin(), parts.forces.heard.end());
  parts.forces.heard.clear();
  parts.buttons.set(buttons_);
  if (silent_) return;
  for (std::size_t i = 0; i < 3; ++i) pose_.position[i] += glide_[i] * period;
  if (held_) {
    const std::array<float, 3> force = fields_.empty() ? std::array<float, 3>{} : fields_.back().force;
    hand_.move({force[0], force[1], force[2]}, period);
    pose_.position = hand_.position;
    pose_.velocity = hand_.velocity;
  }
  timeval now{};
  vrpn_gettimeofday(&now, nullptr);
  parts.tracker.report_pose(0, now, pose_.position.data(), pose_.turn.data());
  ++reports_;
  const double still[4] = {0.0, 0.0, 0.0, 1.0};
  if (pose_.says_velocity) parts.tracker.report_pose_velocity(0, now, pose_.velocity.data(), still, period);
}

void VrpnServer::pose(const HandlePose& pose) {
  const std::lock_guard lock(guard_);
  pose_ = pose;
}

void VrpnServer::glide(const std::array<double, 3>& velocity) {
  const std::lock_guard lock(guard_);
  glide_ = velocity;
}

void VrpnServer::send_hand(double stiffness, const std::array<double, 3>& goal) {
  const std::lock_guard lock(guard_);
  hand_.stiffness = stiffness;
  hand_.goal = goal;
  held_ = true;
}

std::array<double, 3> VrpnServer::position() const {
  const std::lock_guard lock(guard_);
  return pose_.position;
}

void VrpnServer::press(int button, bool down) {
  const std::lock_guard lock(guard_);
  const unsigned bit = 1U << static_cast<unsigned>(button);
  buttons_ = down ? buttons_ | bit : buttons_ & ~bit;
}

std::vector<ForceField> VrpnServer::fields() const {
  const std::lock_guard lock(guard_);
  return fields_;
}

ForceField VrpnServer::last_field() const {
  const std::lock_guard lock(guard_);
  return fields_.empty() ? ForceField{} : fields_.back();
}
