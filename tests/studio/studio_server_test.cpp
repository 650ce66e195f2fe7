// Pages at the server, over real sockets: what they are told, who leads, and what a bad one cannot do.
#include "studio/studio_server.h"

#include <gtest/gtest.h>

#include <cstring>
#include <nlohmann/json.hpp>
#include <set>
#include <thread>

#include "acus/haptics/pace.h"
#include "acus/haptics/simulated_device.h"
#include "acus/haptics/virtual_coupling.h"
#include "tests/net/raw_socket.h"

namespace acus::app {
namespace {

using net::WebSocket;
using nlohmann::json;
constexpr double long_enough = 30.0;  // s, on a machine that does much else

Scene bare_column() {
  Scene scene;
  scene.tissue.rigid = true;
  scene.needle.length = 0.2;
  return scene;
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
  unsigned short port() const {
    const std::string address = server_->address();
    return static_cast<unsigned short>(std::stoi(address.substr(std::strlen("http://127.0.0.1:"))));
  }
  std::string token() const { return server_->address().substr(server_->address().find("token=") + 6); }

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
  explicit Page(const Running& server) {
    const std::string host = "127.0.0.1:" + std::to_string(server.port());
    Result<std::unique_ptr<WebSocket>> socket =
        WebSocket::connect("127.0.0.1", server.port(), long_enough, "/socket?token=" + server.token(),
                           std::string("http://").append(host));
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
    return socket_->receive(message, long_enough) == WebSocket::Received::message;
  }

  std::unique_ptr<WebSocket> socket_;
  std::string frame_;
};

TEST(StudioServer, tells_a_page_what_there_is_and_shows_it_moving) {
  const Running server(led_engine(bare_column()));
  Page page(server);
  const json hello = page.next("hello");
  EXPECT_EQ(hello["source"], "serve");
  EXPECT_TRUE(hello["device"].is_null());
  const json model = page.next("model");
  EXPECT_EQ(model["needle_length_m"], 0.2);
  EXPECT_TRUE(page.say({{"type", "push"}, {"travel_m", 5e-3}}));
  constexpr std::size_t hand_travel = 1, hand_force = 2;
  double travel = 0.0;
  for (int i = 0; i < 1000 && travel < 5e-3; ++i) travel = page.number(hand_travel);
  EXPECT_NEAR(travel, 5e-3, 1e-9);
  EXPECT_GT(page.number(hand_force), 0.5);  // bent against the stop, near its critical load of 0.64 N
  const json loop = page.next("loop");
  EXPECT_EQ(loop.count("real_time_factor"), 1U);
  EXPECT_EQ(loop["owner"], true);
}

TEST(StudioServer, tells_whoever_comes_later_what_has_happened) {
  const Running server(led_engine(bare_column()));
  Page first(server);
  first.say({{"type", "push"}, {"travel_m", 5e-3}});
  EXPECT_EQ(first.next("event")["event"], "contact");
  EXPECT_EQ(first.next("event")["event"], "buckling");
  Page second(server);
  second.next("model");
  EXPECT_EQ(second.next("event")["event"], "contact");
  EXPECT_EQ(second.next("event")["event"], "buckling");
}

TEST(StudioServer, lets_one_page_lead_at_a_time) {
  const Running server(led_engine(bare_column()));
  Page second(server);
  std::atomic<bool> leads{false}, gone{false};
  std::thread first([&] {  // as a page does
    Page page(server);
    for (; !gone; std::this_thread::sleep_for(std::chrono::milliseconds(100))) {
      page.say({{"type", "hold"}});
      page.say({{"type", "check"}, {"scene", ""}});
      page.next("expectation");
      leads = true;
    }
  });
  while (!leads) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  second.say({{"type", "steady"}, {"speed_m_s", 0.01}});
  EXPECT_NE(second.next("refused")["sentence"].get<std::string>().find("another page leads"),
            std::string::npos);
  EXPECT_EQ(second.next("loop")["owner"], false);
  second.say({{"type", "check"}, {"scene", "needle.length_mm = 300"}});  // to ask is free
  EXPECT_NEAR(second.next("expectation")["critical_load_N"].get<double>(), 0.2854, 1e-3);
  gone = true;
  first.join();
  constexpr std::size_t hand_travel = 1;
  double travel = 0.0;  // as soon as the first is seen to have gone
  for (int i = 0; i < 2000 && travel < 1e-4; ++i) {
    second.say({{"type", "steady"}, {"speed_m_s", 0.01}});
    travel = second.number(hand_travel);
  }
  EXPECT_GE(travel, 1e-4);
}

TEST(StudioServer, holds_the_hand_still_when_whoever_led_falls_silent) {
  const Running server(led_engine(bare_column()));
  Page silent(server), watching(server);
  silent.say({{"type", "steady"}, {"speed_m_s", 1e-3}});
  constexpr std::size_t time = 0, hand_travel = 1;
  double moment = 0.0;
  while (moment < 3.0) moment = watching.number(time);  // a second and a generous rest
  const double travel = watching.number(hand_travel);
  EXPECT_GT(travel, 0.5e-3);
  while (moment < 3.5) moment = watching.number(time);
  EXPECT_EQ(watching.number(hand_travel), travel);
}

TEST(StudioServer, answers_what_makes_no_sense_in_one_sentence) {
  const Running server(led_engine(bare_column()));
  Page page(server);
  for (const char* nonsense :
       {"{", "[]", "{\"type\":\"dance\"}", "{\"type\":\"push\"}", "{\"type\":\"push\",\"travel_m\":1e999}"}) {
    EXPECT_TRUE(page.say_text(nonsense));
    EXPECT_FALSE(page.next("refused")["sentence"].get<std::string>().empty()) << nonsense;
  }
  page.say({{"type", "start"}, {"scene", "needle.lenght_mm = 1"}});
  EXPECT_NE(page.next("refused")["sentence"].get<std::string>().find("needle.length_mm"), std::string::npos);
  page.say({{"type", "start"}, {"scene", "tissue.rigid = true\nneedle.length_mm = 150"}});
  EXPECT_EQ(page.next("model")["needle_length_m"], 0.15);
}

TEST(StudioServer, shuts_the_door_on_a_page_that_shouts) {
  const Running server(led_engine(bare_column()));
  Page quiet(server), loud(server);
  for (int i = 0; i < 1000; ++i)
    if (!loud.say({{"type", "hold"}})) break;
  EXPECT_TRUE(loud.closed());
  EXPECT_FALSE(std::isnan(quiet.number(0)));
}

TEST(StudioServer, goes_on_beside_a_page_that_never_reads) {
  const Running server(led_engine(bare_column()));
  Page deaf(server), page(server);
  const double before = page.number(0);
  double after = before;
  for (int i = 0; i < 2000 && after < before + 1.0; ++i) after = page.number(0);
  EXPECT_GE(after, before + 1.0);
}

// The status and the head of an answer.
std::string answer(const Running& server, const std::string& request) {
  const net::RawSocket raw(server.port());
  raw.write(request + "\r\n\r\n");
  return raw.read_to("\r\n\r\n");
}

TEST(StudioServer, gives_its_files_to_whoever_names_it) {
  const Running server(led_engine(bare_column()));
  const std::string us = "Host: 127.0.0.1:" + std::to_string(server.port());
  const std::string page = answer(server, "GET / HTTP/1.1\r\n" + us);
  EXPECT_EQ(page.substr(0, 12), "HTTP/1.1 200");
  for (const char* line :
       {"Content-Type: text/html", "Content-Security-Policy: default-src 'self'", "frame-ancestors 'none'",
        "X-Content-Type-Options: nosniff", "Cross-Origin-Resource-Policy: same-origin"})
    EXPECT_NE(page.find(line), std::string::npos) << line << page;
  EXPECT_EQ(page.find(server.token()), std::string::npos);  // nobody learns the token from the page
  EXPECT_EQ(answer(server, "GET /index.html?token=1 HTTP/1.1\r\n" + us).substr(0, 12), "HTTP/1.1 200");
  for (const char* path :
       {"/absent", "/../etc/passwd", "/%2e%2e/etc/passwd", "//index.html", "/.", "/index.html/"})
    EXPECT_EQ(answer(server, "GET " + std::string(path) + " HTTP/1.1\r\n" + us).substr(0, 12), "HTTP/1.1 404")
        << path;
  EXPECT_EQ(answer(server, "DELETE / HTTP/1.1\r\n" + us).substr(0, 12), "HTTP/1.1 405");
  EXPECT_EQ(answer(server, "GET / HTTP/1.1\r\nHost: evil.example").substr(0, 12), "HTTP/1.1 421");
}

std::unique_ptr<Engine> engine_with_device(double force_limit) {
  const haptics::DeviceLimits& touch = *haptics::find_device_limits("touch");
  haptics::OpenDevice device{
      &haptics::backends()[0],
      std::make_unique<haptics::SimulatedDevice>(touch, haptics::light_grip, [](double time) {
        return std::clamp(40e-3 * (time - 0.8), 0.0, 40e-3);
      })};
  return device_engine(std::move(device), Simulation::build(haptics::held_by(touch, bare_column())).value(),
                       {force_limit, nullptr});
}

TEST(StudioServer, shows_a_device_and_takes_its_force_away) {
  const Running server(engine_with_device(2.0));
  Page page(server);
  EXPECT_EQ(page.next("hello")["device"], "3D Systems Touch (Phantom Omni)");
  json loop = page.next("loop");
  EXPECT_EQ(loop["force_limit_N"], 2.0);
  for (int i = 0; i < 300 && loop["device_force_N"] < 0.4; ++i) loop = page.next("loop");
  EXPECT_EQ(loop["gate"], "armed");
  page.say({{"type", "push"}, {"travel_m", 0.0}});
  EXPECT_NE(page.next("refused")["sentence"].get<std::string>().find("the device leads"), std::string::npos);
  page.say({{"type", "disarm"}});
  for (int i = 0; i < 300 && loop["device_force_N"] != 0.0; ++i) loop = page.next("loop");
  EXPECT_EQ(loop["device_force_N"], 0.0);
  EXPECT_EQ(loop["gate"], "disarmed");
  page.say({{"type", "start"}, {"scene", "tissue.rigid = true\nneedle.length_mm = 150"}});
  EXPECT_EQ(page.next("model")["needle_length_m"], 0.15);
}

TEST(StudioServer, lets_a_devices_force_go_when_the_page_that_armed_it_falls_silent) {
  const Running server(engine_with_device(0.0));
  Page silent(server), watching(server);
  silent.say({{"type", "arm"}});
  json loop = watching.next("loop");
  for (int i = 0; i < 300 && loop["device_force_N"] < 0.3; ++i) {
    silent.say({{"type", "hold"}});
    loop = watching.next("loop");
  }
  EXPECT_GE(loop["device_force_N"], 0.3);
  for (int i = 0; i < 300 && loop["device_force_N"] != 0.0; ++i) loop = watching.next("loop");
  EXPECT_EQ(loop["device_force_N"], 0.0);
}

}  // namespace
}  // namespace acus::app
