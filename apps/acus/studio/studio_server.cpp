#include "studio_server.h"

#include <algorithm>
#include <thread>
#include <utility>

#include "acus/haptics/pace.h"
#include "acus/io/scene_toml.h"
#include "acus/net/local_access.h"
#include "acus/view/command.h"
#include "acus/view/reports.h"
#include "studio_files.h"

namespace acus::app {
namespace {

constexpr double patience = 5.0;                 // s, with a client that does not read
constexpr double between_looks = 4e-3;           // s
constexpr int most_messages = 200;               // a second, of one client
constexpr std::size_t worth_a_message = 10'000;  // bytes: whoever sends long ones may send fewer
constexpr double between_answers = 0.05;         // s: to foretell what comes of a scene takes milliseconds

// How many messages a client may still send: refilled as time goes by.
class Allowance {
 public:
  explicit Allowance(double now) : last_(now) {}
  // Whether it covers so many more.
  bool take(long messages, double now) {
    left_ = std::min<double>(left_ + most_messages * (now - last_), most_messages);
    last_ = now;
    left_ -= static_cast<double>(messages);
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
  service.gives_way = true;  // to the hand, above all
  service.serve = [&s](net::WebSocket& client, const auto& stopping) { s.serve(client, stopping); };
  Result<std::unique_ptr<net::WebServer>> server = net::WebServer::start(port, std::move(service));
  if (!server) return server.error();
  s.server_ = std::move(*server);
  s.port_ = s.server_->port();
  if (const auto refused = engine.begin()) return *refused;
  return studio;
}

std::string StudioServer::address() const {
  return "http://127.0.0.1:" + std::to_string(port_) + "/?token=" + token_;
}

std::optional<Error> StudioServer::run(const std::atomic<bool>& stop) {
  // Over the lease, until the engine ends: its threads have better to do.
  const std::jthread watching([this](const std::stop_token& over) {
    constexpr std::chrono::milliseconds between(50);
    for (; !over.stop_requested(); std::this_thread::sleep_for(between))
      if (lease_.lapsed(haptics::monotonic_time())) engine_.let_go();
  });
  return engine_.run(broadcast_, stop);
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

struct StudioServer::Visit {
  net::WebSocket& client;
  long number = 0;
  std::optional<view::Check> asked;  // and not answered yet; of several the last
  double answered = -1.0;            // s

  bool say(const std::string& report) { return client.send(report, patience); }
};

void StudioServer::serve(net::WebSocket& client, const std::function<bool()>& stopping) {
  Visit visit{client, ++clients_, {}};
  Allowance allowance(haptics::monotonic_time());
  Broadcast::Place place = broadcast_.beginning();
  std::string message;
  long heard = 0;
  bool there = visit.say(view::hello_report("serve", engine_.device()));
  while (there && !stopping()) {
    const net::WebSocket::Received received = client.receive(message, between_looks);
    const bool told = received == net::WebSocket::Received::message;
    const double now = haptics::monotonic_time();
    const long messages = client.heard() - std::exchange(heard, client.heard()),
               parts = told ? static_cast<long>(message.size() / worth_a_message) : 0;
    there = received != net::WebSocket::Received::closed && allowance.take(messages + parts, now) &&
            (!told || hear(visit, message)) && foretell(visit);
    for (const Broadcast::Report& report : broadcast_.reports_since(place))
      there = there && visit.say(*report);
    if (const auto status = broadcast_.status_since(place))
      there = there && visit.say(with_owner(*status, lease_.is_open_to(visit.number, now)));
    if (there && broadcast_.frame_since(place, message)) there = client.send_bytes(message, patience);
  }
  lease_.give_back(visit.number);
}

// False when the client is to go.
bool StudioServer::hear(Visit& visit, const std::string& message) {
  Result<view::Command> command = view::parse_command(message);
  if (!command) return visit.say(view::refused_report(command.error().sentence));
  if (auto* check = std::get_if<view::Check>(&*command)) {
    visit.asked = std::move(*check);
    return true;
  }
  if (!lease_.take(visit.number, haptics::monotonic_time()))
    return visit.say(
        view::refused_report("another page leads; it is your turn a second after it has let go"));
  if (!std::holds_alternative<view::Hold>(*command)) engine_.take(message);
  return true;
}

// What would come of the scene that was asked about, unless the last answer was given just now.
bool StudioServer::foretell(Visit& visit) {
  if (!visit.asked || haptics::monotonic_time() - visit.answered < between_answers) return true;
  const Result<Scene> scene = io::parse_scene(visit.asked->scene.toml, "scene", visit.asked->scene.settings);
  const bool there =
      visit.say(scene ? view::expectation_report(*scene) : view::refused_report(scene.error().sentence));
  visit.asked.reset();
  visit.answered = haptics::monotonic_time();
  return there;
}

}  // namespace acus::app
