#include "acus/haptics/haply_emulator.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <mutex>
#include <nlohmann/json.hpp>
#include <thread>

#include "acus/haptics/pace.h"
#include "acus/net/web_socket.h"

namespace acus::haptics {
namespace {

using haply::Dialect;
using nlohmann::ordered_json;

constexpr const char* device_name = "049D";
constexpr const char* grip_name = "61548";
constexpr double send_patience = 1.0;    // s
constexpr double between_looks = 20e-3;  // s, at whether to stop
constexpr double lateness = 8e-3;        // s
constexpr long one_in = 5;               // replies
constexpr std::size_t longest_transcript = 400;
constexpr std::size_t most_commands = 1'000'000;  // that are kept: of a quarter of an hour

constexpr std::array<std::pair<const char*, HaplyFaultKind>, 6> fault_names{{
    {"late", HaplyFaultKind::late},
    {"dropped", HaplyFaultKind::dropped},
    {"malformed", HaplyFaultKind::malformed},
    {"uncalibrated", HaplyFaultKind::uncalibrated},
    {"unplugged", HaplyFaultKind::unplugged},
    {"silent", HaplyFaultKind::silent},
}};

ordered_json vector_json(const Vec3& v) { return {{"x", v.x()}, {"y", v.y()}, {"z", v.z()}}; }

const ordered_json no_turn = {{"w", 1.0}, {"x", 0.0}, {"y", 0.0}, {"z", 0.0}};

ordered_json state_json(const Vec3& position, const Vec3& velocity, const Vec3& force) {
  return {{"cursor_position", vector_json(position)},
          {"cursor_velocity", vector_json(velocity)},
          {"angular_position", {{"a0", 0.0}, {"a1", 0.0}, {"a2", 0.0}}},
          {"angular_velocity", {{"a0", 0.0}, {"a1", 0.0}, {"a2", 0.0}}},
          {"body_orientation", no_turn},
          {"current_cursor_force", vector_json(force)},
          {"control_domain", "cartesian"},
          {"control_mode", "idle"}};
}

ordered_json status_json(bool calibrated) {
  return {{"calibrated", calibrated},
          {"in_use", false},
          {"power_supply", true},
          {"ready", true},
          {"started", true}};
}

// What only the first message of a session says of the device.
ordered_json config_json(Dialect dialect) {
  ordered_json config = {{"type", "inverse3"},
                         {"port", "emulated"},
                         {"device_info", {{"major_version", 7}, {"minor_version", 4}, {"id", device_name}}},
                         {"gravity_compensation", {{"enabled", true}, {"scaling_factor", 1.0}}},
                         {"handedness", "right"},
                         {"torque_scaling", {{"enabled", true}}}};
  if (dialect == Dialect::vector) config["basis"] = {{"permutation", "XYZ"}};
  return config;
}

ordered_json grip_json() {
  return {{"device_id", grip_name},
          {"state",
           {{"orientation", no_turn},
            {"buttons", {{"a", false}, {"b", false}, {"c", false}}},
            {"battery_level", 0.9}}},
          {"status", {{"connected", true}}}};
}

}  // namespace

Result<HaplyFault> haply_fault(const std::string& text) {
  const std::size_t at = text.find('@');
  const std::string name = text.substr(0, at);
  const auto* found = std::find_if(fault_names.begin(), fault_names.end(),
                                   [&](const auto& one) { return one.first == name; });
  if (found != fault_names.end() && at != std::string::npos) {
    const char* from = text.c_str() + at + 1;
    char* end = nullptr;
    HaplyFault fault{found->second, std::strtod(from, &end), 0.0};
    double lasts = 1.0;  // s
    bool sound = end != from;
    if (sound && *end == ':') {
      from = end + 1;
      lasts = std::strtod(from, &end);
      sound = end != from;
    }
    fault.to = fault.from + lasts;
    if (sound && *end == '\0' && fault.from >= 0.0 && lasts > 0.0 && std::isfinite(fault.to)) return fault;
  }
  std::string names;
  for (const auto& [known, kind] : fault_names) names += (names.empty() ? "" : ", ") + std::string(known);
  return Error{
      "'" + text +
      "' is no fault: write KIND@SECONDS or KIND@SECONDS:FOR_SECONDS, as in late@3:0.5; the kinds are " +
      names};
}

class HaplyEmulator::Service {
 public:
  explicit Service(HaplyEmulatorSettings settings)
      : settings_(std::move(settings)),
        limits_(*find_device_limits("inverse3")),
        handle_(limits_, settings_.hand) {}

  std::optional<Error> start() {
    net::WebService service;
    service.answer = [this](const net::WebRequest& request) { return answer(request.target); };
    service.serve = [this](net::WebSocket& client, const auto& stopping) { serve(client, stopping); };
    Result<std::unique_ptr<net::WebServer>> server =
        net::WebServer::start(settings_.port, std::move(service));
    if (!server) return server.error();
    server_ = std::move(*server);
    return std::nullopt;
  }

  unsigned short port() const { return server_->port(); }

  std::vector<HaplyCommand> commands() const {
    const std::lock_guard lock(mutex_);
    return commands_;
  }

  long came() const {
    const std::lock_guard lock(mutex_);
    return came_;
  }

  std::vector<std::string> transcript() const {
    const std::lock_guard lock(mutex_);
    return transcript_;
  }

 private:
  net::WebAnswer answer(const std::string& target) const {
    const std::string body = json_at(target);
    return {body.empty() ? 404U : 200U, "application/json", body};
  }

  std::string json_at(const std::string& target) const {
    if (target == "/version" || target == "/3.1/version")
      return ordered_json{{"version", settings_.dialect == Dialect::vector ? "3.5.0" : "3.1.1"},
                          {"emulator", "acus"}}
          .dump();
    if (target == "/devices" || target == "/3.1/devices")
      return ordered_json{{"inverse3", {device_name}}, {"wireless_verse_grip", {grip_name}}}.dump();
    return {};
  }

  void serve(net::WebSocket& client, const std::function<bool()>& stopping) {
    send(client, inventory(true));
    std::string message;
    for (long number = 1; !stopping();) {
      const net::WebSocket::Received received = client.receive(message, between_looks);
      if (received == net::WebSocket::Received::closed) return;
      if (received == net::WebSocket::Received::message) answer(client, message, number++);
    }
  }

  void answer(net::WebSocket& client, const std::string& message, long number) {
    note("< " + message);
    advance();
    obey(message);
    std::string reply = inventory(false);
    if (now(HaplyFaultKind::silent)) return;
    if (now(HaplyFaultKind::dropped) && number % one_in == 0) return;
    if (now(HaplyFaultKind::malformed) && number % one_in == 0) reply.resize(reply.size() / 2);
    if (now(HaplyFaultKind::late)) std::this_thread::sleep_for(std::chrono::duration<double>(lateness));
    send(client, reply);
  }

  void send(net::WebSocket& client, const std::string& message) {
    note("> " + message);
    client.send(message, send_patience);
  }

  void note(const std::string& line) {
    const std::lock_guard lock(mutex_);
    if (transcript_.size() < longest_transcript) transcript_.push_back(line);
  }

  // Handle and hand come to where they are now.
  void advance() {
    const std::lock_guard lock(mutex_);
    if (begin_ < 0.0) begin_ = monotonic_time();
    const double time = monotonic_time() - begin_, before = handle_.time();
    if (time <= before) return;
    const auto plan = [this](double t) { return settings_.plan ? settings_.plan(t) : 0.0; };
    const double aim = plan(time), aim_before = plan(before);
    handle_.advance_to(time,
                       {limits_.forward * aim, limits_.forward * ((aim - aim_before) / (time - before))});
  }

  // A command with anything else than a force for this device, in the words of this version, moves nothing.
  void obey(const std::string& message) {
    const ordered_json json = ordered_json::parse(message, nullptr, false);
    const char* words = settings_.dialect == Dialect::vector ? "vector" : "values";
    try {
      const ordered_json& device = json.at("inverse3").at(0);
      if (device.at("device_id") != device_name) return;
      const ordered_json& force = device.at("commands").at("set_cursor_force").at(words);
      const std::lock_guard lock(mutex_);
      force_ = {force.at("x").get<double>(), force.at("y").get<double>(), force.at("z").get<double>()};
      handle_.command(force_);
      ++came_;
      if (commands_.size() < most_commands) commands_.push_back({handle_.time(), force_, handle_.position()});
    } catch (const ordered_json::exception&) {
    }
  }

  bool now(HaplyFaultKind kind) const {
    const std::lock_guard lock(mutex_);
    return std::any_of(settings_.faults.begin(), settings_.faults.end(), [&](const HaplyFault& fault) {
      return fault.kind == kind && handle_.time() >= fault.from && handle_.time() < fault.to;
    });
  }

  // All devices: at first with what they are, then with how they are.
  std::string inventory(bool first) {
    const bool there = !now(HaplyFaultKind::unplugged), calibrated = !now(HaplyFaultKind::uncalibrated);
    const std::lock_guard lock(mutex_);
    ordered_json message = ordered_json::object();
    if (first && settings_.dialect == Dialect::vector) message["session_id"] = ++sessions_;
    message["inverse3"] = ordered_json::array();
    if (there) {
      ordered_json device = {{"device_id", device_name}};
      if (first) device["config"] = config_json(settings_.dialect);
      device["state"] = state_json(handle_.encoder(), handle_.velocity(), force_);
      device["status"] = status_json(calibrated);
      message["inverse3"].push_back(device);
    }
    message["wireless_verse_grip"] = ordered_json::array({grip_json()});
    return message.dump();
  }

  HaplyEmulatorSettings settings_;
  DeviceLimits limits_;
  mutable std::mutex mutex_;  // of the following
  Handle handle_;
  Vec3 force_ = Vec3::Zero();
  double begin_ = -1.0;  // s, of the first message; negative before
  int sessions_ = 0;
  std::vector<HaplyCommand> commands_;
  long came_ = 0;  // commands, kept or not
  std::vector<std::string> transcript_;
  std::unique_ptr<net::WebServer> server_;  // last: its threads use the others
};

HaplyEmulator::HaplyEmulator(std::unique_ptr<Service> service) : service_(std::move(service)) {}
HaplyEmulator::~HaplyEmulator() = default;

Result<std::unique_ptr<HaplyEmulator>> HaplyEmulator::start(HaplyEmulatorSettings settings) {
  auto service = std::make_unique<Service>(std::move(settings));
  if (const auto refused = service->start()) return *refused;
  return std::unique_ptr<HaplyEmulator>(new HaplyEmulator(std::move(service)));
}

unsigned short HaplyEmulator::port() const { return service_->port(); }
std::vector<HaplyCommand> HaplyEmulator::commands() const { return service_->commands(); }
long HaplyEmulator::came() const { return service_->came(); }
std::vector<std::string> HaplyEmulator::transcript() const { return service_->transcript(); }

}  // namespace acus::haptics
