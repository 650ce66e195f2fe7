// For tests of the studio's server: one that runs, and pages at it without a browser.
#pragma once

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <cstring>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <thread>

#include "acus/haptics/pace.h"
#include "acus/haptics/simulated_device.h"
#include "acus/haptics/virtual_coupling.h"
#include "studio/studio_server.h"

namespace acus::app {

using nlohmann::json;
inline constexpr double long_enough = 30.0;  // s, on a machine that does much else

inline Scene bare_column() {
  Scene scene;
  scene.tissue.rigid = true;
  scene.needle.length = 0.2;
  return scene;
}

// A hand that goes in until the column bends, and out again, every two seconds: where a busy machine has cost
// the force, it can be armed again.
inline std::unique_ptr<Engine> engine_with_device(const DeviceSettings& settings) {
  const haptics::DeviceLimits& touch = *haptics::find_device_limits("touch");
  haptics::OpenDevice device{&haptics::backends()[0], std::make_unique<haptics::SimulatedDevice>(
                                                          touch, haptics::light_grip, [](double time) {
                                                            constexpr double way = 20e-3,
                                                                             turn = 3.14;  // m, 1/s
                                                            return 0.5 * way * (1.0 - std::cos(turn * time));
                                                          })};
  return device_engine(std::move(device), Simulation::build(haptics::held_by(touch, bare_column())).value(),
                       settings);
}

// Of the address that it prints.
inline unsigned short port_of(const StudioServer& server) {
  return static_cast<unsigned short>(std::stoi(server.address().substr(std::strlen("http://127.0.0.1:"))));
}
inline std::string token_of(const StudioServer& server) {
  return server.address().substr(server.address().find("token=") + std::strlen("token="));
}

class Running {
 public:
  explicit Running(std::unique_ptr<Engine> engine)
      : engine_(std::move(engine)), server_(StudioServer::start(0, *engine_).value()) {
    thread_ = std::thread([this] { failed_ = server_->run(stop_); });
  }
  ~Running() {
    stop_ = true;
    thread_.join();
    EXPECT_FALSE(failed_) << failed_->sentence;
  }
  unsigned short port() const { return port_of(*server_); }
  std::string token() const { return token_of(*server_); }
  const StudioServer& server() const { return *server_; }

 private:
  std::unique_ptr<Engine> engine_;
  std::unique_ptr<StudioServer> server_;
  std::atomic<bool> stop_{false};
  std::optional<Error> failed_;
  std::thread thread_;
};

// A page, without a browser.
class Page {
 public:
  explicit Page(const Running& server) : Page(server.server()) {}
  explicit Page(const StudioServer& server) {
    const std::string host = "127.0.0.1:" + std::to_string(port_of(server));
    Result<std::unique_ptr<net::WebSocket>> socket =
        net::WebSocket::connect("127.0.0.1", port_of(server), long_enough,
                                "/socket?token=" + token_of(server), std::string("http://").append(host));
    EXPECT_TRUE(socket) << (socket ? "" : socket.error().sentence);
    socket_ = std::move(*socket);
  }

  bool say(const json& command) { return say_text(command.dump()); }
  bool say_text(const std::string& text) { return socket_->send(text, long_enough); }

  // The next report of a type; what comes before it is dropped, but for frames.
  json next(const std::string& type) {
    const double begun = haptics::monotonic_time();
    for (std::string message; haptics::monotonic_time() - begun < long_enough && hears(message);) {
      if (message.starts_with("1ACF")) {
        frame_ = message;
        continue;
      }
      json report = json::parse(message);
      if (report["type"] == type) return report;
    }
    ADD_FAILURE() << "no " << type << " came";
    return {};
  }
  // Number `column` of the next frame.
  double number(std::size_t column) {
    for (frame_.clear(); frame_.empty();) {
      std::string message;
      if (!hears(message)) break;
      if (message.starts_with("1ACF")) frame_ = message;
    }
    double value = std::nan("");
    if (frame_.size() >= 208) std::memcpy(&value, frame_.data() + 16 + 8 * column, sizeof value);
    return value;
  }
  bool closed() {
    std::string message;
    while (hears(message)) {
    }
    return true;
  }

 private:
  bool hears(std::string& message) {
    return socket_->receive(message, long_enough) == net::WebSocket::Received::message;
  }

  std::unique_ptr<net::WebSocket> socket_;
  std::string frame_;
};

}  // namespace acus::app
