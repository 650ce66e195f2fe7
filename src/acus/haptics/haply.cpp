#include "acus/haptics/haply.h"

#include <cassert>
#include <charconv>
#include <utility>

#include "acus/haptics/haply_protocol.h"
#include "acus/haptics/pace.h"
#include "acus/net/web_socket.h"

namespace acus::haptics {
namespace {

using net::WebSocket;

constexpr unsigned short usual_port = 10001;
constexpr double period = 1e-3;           // s
constexpr double opening_patience = 2.0;  // s
constexpr double reply_patience = 10e-3;  // s: then the message is sent again; sooner, messages could pile up
constexpr double force_patience = 20e-3;  // s without a reply: the force is let go
constexpr double patience = 0.5;          // s without one: the device is lost

struct Service {
  std::unique_ptr<WebSocket> socket;
  haply::Inventory known;
};

// Connects and hears what there is.
Result<Service> reach(unsigned short port, double patience_to_connect) {
  const std::string where = "the Haply Inverse Service on port " + std::to_string(port);
  Result<std::unique_ptr<WebSocket>> socket = WebSocket::connect("127.0.0.1", port, patience_to_connect);
  if (!socket)
    return Error{where + " cannot be reached: " + socket.error().sentence +
                 "; install Haply's Hub or service and start it, or name its port, as in haply:10000"};
  Service service{std::move(*socket), {}};
  std::string message;
  if (service.socket->receive(message, patience_to_connect) != WebSocket::Received::message)
    return Error{where + " does not say which devices it has; is it of version 3.1 or newer?"};
  if (const auto wrong = haply::read_message(message, service.known))
    return Error{where + ": " + wrong->sentence};
  if (!service.known.present) return Error{where + " has no Inverse3: is it plugged in and switched on?"};
  return service;
}

Result<unsigned short> port_of(const std::string& argument) {
  if (argument.empty()) return usual_port;
  unsigned short port = 0;
  const auto [end, wrong] = std::from_chars(argument.data(), argument.data() + argument.size(), port);
  if (wrong != std::errc() || end != argument.data() + argument.size() || port == 0)
    return Error{"'" + argument + "' is no port: give a number from 1 to 65535, as in haply:10001"};
  return port;
}

class Haply final : public Device {
 public:
  Haply(Service service, unsigned short port) : service_(std::move(service)), port_(port) {
    const DeviceLimits* row = find_device_limits("inverse3");
    assert(row);
    limits_ = *row;
  }

  const DeviceLimits& limits() const override { return limits_; }

  std::optional<Error> serve(Tick& tick, const std::atomic<bool>& stop) override {
    if (!service_.socket) {  // served before: a service knows a session by its connection
      Result<Service> again = reach(port_, opening_patience);
      if (!again) return again.error();
      service_ = std::move(*again);
    }
    first_ = true;
    std::optional<Error> lost = run(tick, stop);
    if (!lost && !ask(Vec3::Zero(), patience)) lost = silence();
    service_.socket.reset();
    return lost;
  }

 private:
  // A message a millisecond, each with the force that answers the last state; a reply that does not come is
  // asked for again, and says the same whenever it comes.
  std::optional<Error> run(Tick& tick, const std::atomic<bool>& stop) {
    Vec3 force = Vec3::Zero();
    Pace pace(period);
    heard_ = monotonic_time();
    for (; !stop; pace.wait()) {
      const bool answered = ask(force, reply_patience);
      const double now = monotonic_time();
      if (over_ || now - heard_ > patience) return silence();
      if (!answered && now - heard_ < force_patience) continue;
      DeviceState state;
      state.time = now;
      state.position = service_.known.position;
      state.velocity = service_.known.velocity;
      state.orientation = service_.known.orientation;
      state.buttons = service_.known.buttons;
      state.ready = answered && service_.known.calibrated;
      const Wrench wanted = tick(state);
      force = state.ready ? wanted.force : Vec3(Vec3::Zero());
    }
    return std::nullopt;
  }

  // Sends a force and takes the state that answers it; replies that came late are read first and forgotten,
  // but no service that talks without end keeps us.
  bool ask(const Vec3& force, double wait) {
    constexpr int most = 100;
    for (int late = 0; late < most && hear(0.0); ++late) {
    }
    over_ = over_ || !service_.socket->send(
                         haply::force_message(service_.known, force, std::exchange(first_, false)), patience);
    return hear(wait);
  }

  bool hear(double wait) {
    if (over_) return false;
    const WebSocket::Received received = service_.socket->receive(message_, wait);
    over_ = received == WebSocket::Received::closed;
    if (received != WebSocket::Received::message) return false;
    const std::optional<Error> wrong = haply::read_message(message_, service_.known);
    if (wrong) wrong_ = wrong->sentence;
    if (wrong || !service_.known.present) return false;
    heard_ = monotonic_time();
    return true;
  }

  Error silence() const {
    const char* what = over_ ? "the Haply Inverse Service has closed the connection"
                       : !service_.known.present
                           ? "the Haply Inverse Service has no such Inverse3 any more"
                           : "the Haply Inverse Service has been silent for half a second";
    return Error{"the device was lost: " + std::string(what) + (wrong_.empty() ? "" : " (" + wrong_ + ")") +
                 "; is it still plugged in?"};
  }

  Service service_;
  unsigned short port_;
  DeviceLimits limits_;
  std::string message_, wrong_;
  bool first_ = true, over_ = false;
  double heard_ = 0.0;  // s, when it last said where it is
};

}  // namespace

std::string haply_missing() {
  constexpr double short_patience = 0.3;  // s
  const Result<Service> service = reach(usual_port, short_patience);
  return service ? "" : service.error().sentence;
}

Result<std::unique_ptr<Device>> open_haply(const std::string& argument) {
  const Result<unsigned short> port = port_of(argument);
  if (!port) return port.error();
  Result<Service> service = reach(*port, opening_patience);
  if (!service) return service.error();
  return std::unique_ptr<Device>(std::make_unique<Haply>(std::move(*service), *port));
}

}  // namespace acus::haptics
