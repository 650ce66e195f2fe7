// A VRPN server on a thread of the test, made of VRPN's own parts: a tracker, buttons and a force device that
// writes down the force fields it is sent. It knows nothing of acus.
#pragma once

#include <array>
#include <atomic>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "emulators/fake_hand.h"

struct ForceField {
  std::array<float, 3> origin{}, force{};  // m, N
  std::array<float, 9> jacobian{};         // N/m
  float radius = 0.0F;                     // m
};

struct HandlePose {
  std::array<double, 3> position{};                // m
  std::array<double, 4> turn{0.0, 0.0, 0.0, 1.0};  // x, y, z, w
  std::array<double, 3> velocity{};                // m/s
  bool says_velocity = true;
};

class VrpnServer {
 public:
  // Serves the device `name` at 127.0.0.1, a thousand reports a second.
  explicit VrpnServer(const std::string& name);
  ~VrpnServer();
  VrpnServer(const VrpnServer&) = delete;
  VrpnServer& operator=(const VrpnServer&) = delete;

  int port() const { return port_; }
  std::string address() const;  // NAME@HOST:PORT

  void pose(const HandlePose& pose);
  // The handle goes on by so much with each report. m/s
  void glide(const std::array<double, 3>& velocity);
  // A hand that is held to `goal` [m] by a spring [N/m], and moved by the force fields.
  void send_hand(double stiffness, const std::array<double, 3>& goal);
  std::array<double, 3> position() const;
  void press(int button, bool down);
  void be_silent(bool silent) { silent_ = silent; }  // of the tracker; the connection stays
  void stop();                                       // closes the connection

  std::vector<ForceField> fields() const;  // all, in the order in which they came
  ForceField last_field() const;
  long reports() const { return reports_; }

 private:
  struct Parts;
  void run();
  void report(Parts& parts);

  std::string name_;
  int port_;
  mutable std::mutex guard_;  // of the next few
  HandlePose pose_;
  std::array<double, 3> glide_{};
  FakeHand hand_;
  bool held_ = false;  // by that hand
  std::vector<ForceField> fields_;
  unsigned buttons_ = 0;
  std::atomic<bool> silent_{false}, stopping_{false}, running_{false};
  std::atomic<long> reports_{0};
  std::thread thread_;  // last: it uses the others
};
