#include "studio_server.h"

#include <thread>

#include "acus/haptics/pace.h"
#include "acus/io/scene_toml.h"
#include "acus/net/local_access.h"
#include "acus/view/command.h"
#include "acus/view/reports.h"
#include "studio_files.h"

namespace acus::app {
namespace {

constexpr double patience = 5.0;        // s, with a client that does not read
constexpr double between_looks = 4e-3;  // s
constexpr int most_messages = 200;      // a second, of one client

// How many messages a client may still send: refilled as time goes by.
class Allowance {
 public:
  explicit Allowance(double now) : last_(now) {}
  bool take(double now) {
    left_ = std::min<double>(left_ + most_messages * (now - last_), most_messages);
    last_ = now;
    left_ -= 1.0;
    return left_ >= 0.0;
  }

 private:
  double left_ = most_messages, last_;  // messages; s
};

// The report `loop`, and whether whoever is told may lead.
std::string with_owner(std::string status, bool owner) {
  status.pop_back();  // its last bracket
  return status + (owner ? R"(,"owner":true})" : R"(,"owner":false})");
}

}  // namespace

StudioServer::StudioServer(Engine& engine) : engine_(engine), token_(net::new_token()) {}

Result<std::unique_ptr<StudioServer>> StudioServer::start(unsigned short port, Engine& engine) {
  std::unique_ptr<StudioServer> studio(new StudioServer(engine));
  StudioServer& s = *studio;
  net::WebService service;
  service.answer = [&s](const net::WebRequest& request) { return s.answer(request); };
  service.admits = [&s](const net::WebRequest& request) {
    return net::may_lead(request, static_cast<unsigned short>(s.port_), s.token_);
  };
  service.serve = [&s](net::WebSocket& client, const auto& stopping) { s.serve(client, stopping); };
  Result<std::unique_ptr<net::WebServer>> server = net::WebServer::start(port, std::move(service));
  if (!server) return server.error();
  s.server_ = std::move(*server);
  s.port_ = s.server_->port();
  return studio;
}

std::string StudioServer::address() const {
  return "http://127.0.0.1:" + std::to_string(port_) + "/?token=" + token_;
}

std::optional<Error> StudioServer::run(const std::atomic<bool>& stop) {
  std::thread watching([this, &stop] {  // over the lease: the engine's threads have better to do
    constexpr std::chrono::milliseconds between(50);
    for (; !stop; std::this_thread::sleep_for(between))
      if (lease_.lapsed(haptics::monotonic_time())) engine_.let_go();
  });
  std::optional<Error> failed = engine_.run(broadcast_, stop);
  watching.join();
  return failed;
}

net::WebAnswer StudioServer::answer(const net::WebRequest& request) const {
  if (!net::names_us(request, static_cast<unsigned short>(port_)))
    return {421, {}, "this server has another name\n"};
  if (request.method != "GET") return {405, {}, "there is nothing to do here but look\n"};
  const std::string path = request.target.substr(0, request.target.find_first_of("?#"));
  const auto file = studio_file(path == "/" ? "/index.html" : path);
  if (!file) return {404, {}, "there is no such file here\n"};
  return {200, std::string(file->type), std::string(file->bytes)};
}

void StudioServer::serve(net::WebSocket& client, const std::function<bool()>& stopping) {
  const long number = ++clients_;
  Allowance allowance(haptics::monotonic_time());
  Broadcast::Place place = broadcast_.beginning();
  std::string message;
  bool there = client.send(view::hello_report("serve", engine_.device()), patience);
  while (there && !stopping()) {
    switch (client.receive(message, between_looks)) {
      case net::WebSocket::Received::closed:
        there = false;
        break;
      case net::WebSocket::Received::message:
        there = allowance.take(haptics::monotonic_time()) && hear(client, number, message);
        break;
      case net::WebSocket::Received::nothing:
        break;
    }
    for (const std::string& report : broadcast_.reports_since(place))
      there = there && client.send(report, patience);
    if (const auto status = broadcast_.status_since(place))
      there = there && client.send(with_owner(*status, lease_.is_open_to(number, haptics::monotonic_time())),
                                   patience);
    if (there && broadcast_.frame_since(place, message)) there = client.send_bytes(message, patience);
  }
  lease_.give_back(number);
}

// False when the client is to go.
bool StudioServer::hear(net::WebSocket& client, long number, const std::string& message) {
  const Result<view::Command> command = view::parse_command(message);
  if (!command) return client.send(view::refused_report(command.error().sentence), patience);
  if (const auto* check = std::get_if<view::Check>(&*command)) {
    const Result<Scene> scene = io::parse_scene(check->scene.toml, "scene", check->scene.settings);
    return client.send(
        scene ? view::expectation_report(*scene) : view::refused_report(scene.error().sentence), patience);
  }
  if (!lease_.take(number, haptics::monotonic_time()))
    return client.send(
        view::refused_report("another page leads; it is your turn a second after it has let go"), patience);
  if (!std::holds_alternative<view::Hold>(*command)) engine_.take(message);
  return true;
}

}  // namespace acus::app
