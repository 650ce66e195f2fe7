// The Inverse3's backend against an emulator of its service, over the real wire.
#include "acus/haptics/haply.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <set>

#include "acus/haptics/haply_emulator.h"
#include "acus/net/web_socket.h"
#include "serving.h"

namespace acus::haptics {
namespace {

using haply::Dialect;

std::unique_ptr<HaplyEmulator> emulator(Dialect dialect, std::vector<HaplyFault> faults = {}) {
  HaplyEmulatorSettings settings;
  settings.port = 0;
  settings.dialect = dialect;
  settings.faults = std::move(faults);
  settings.plan = [](double time) { return 0.02 * time; };  // m
  Result<std::unique_ptr<HaplyEmulator>> started = HaplyEmulator::start(std::move(settings));
  EXPECT_TRUE(started) << (started ? "" : started.error().sentence);
  return std::move(*started);
}

std::unique_ptr<Device> open_at(unsigned short port) {
  Result<std::unique_ptr<Device>> device = open_haply(std::to_string(port));
  EXPECT_TRUE(device) << (device ? "" : device.error().sentence);
  return std::move(*device);
}

class Haply : public testing::TestWithParam<Dialect> {};
INSTANTIATE_TEST_SUITE_P(Dialects, Haply, testing::Values(Dialect::values, Dialect::vector),
                         [](const auto& dialect) {
                           return dialect.param == Dialect::vector ? "of_3_5" : "of_3_1";
                         });

// A service that says where the device is again and again, whether it is asked or not.
TEST(HaplyService, may_talk_without_end) {
  net::WebService service;
  service.answer = [](const net::WebRequest&) { return net::WebAnswer(); };
  service.serve = [](net::WebSocket& client, const std::function<bool()>& stopping) {
    const std::string state =
        R"({"inverse3":[{"device_id":"1","state":{"cursor_position":{"x":0,"y":0,"z":0}},"status":{"calibrated":true}}]})";
    while (!stopping() && client.send(state, 1.0)) {
    }
  };
  const auto server = net::WebServer::start(0, std::move(service)).value();
  const auto device = open_at(server->port());
  Steady tick;
  Serving serving(*device, tick);
  EXPECT_TRUE(wait_for([&] { return tick.calls > 50; }));
  serving.stop();
}

TEST_P(Haply, says_where_it_is_and_shows_the_force) {
  const auto service = emulator(GetParam());
  const auto device = open_at(service->port());
  EXPECT_EQ(device->limits().name, "inverse3");
  Steady tick({0.25, -0.125, 0.0});
  Serving serving(*device, tick);
  ASSERT_TRUE(wait_for([&] { return tick.calls > 200; }));
  EXPECT_FALSE(serving.stop());
  EXPECT_TRUE(tick.time_goes_on);
  EXPECT_TRUE(tick.last.ready);
  EXPECT_GT(tick.last.position.y(), 0.0);  // the hand goes forward, which is y
  const std::vector<HaplyCommand> commands = service->commands();
  ASSERT_GT(commands.size(), 200U);
  EXPECT_EQ(commands.front().force, Vec3(0.0, 0.0, 0.0));
  EXPECT_GT(
      std::count_if(commands.begin(), commands.end(),
                    [](const HaplyCommand& command) { return command.force == Vec3(0.25, -0.125, 0.0); }),
      100);
  EXPECT_EQ(commands.back().force, Vec3(0.0, 0.0, 0.0));  // it does not leave with a force on
}

TEST_P(Haply, goes_on_through_late_missing_and_broken_replies) {
  const auto service = emulator(GetParam(), {{HaplyFaultKind::late, 0.1, 0.3},
                                             {HaplyFaultKind::dropped, 0.3, 0.6},
                                             {HaplyFaultKind::malformed, 0.6, 0.9}});
  const auto device = open_at(service->port());
  Steady tick({0.25, 0.0, 0.0});
  Serving serving(*device, tick);
  ASSERT_TRUE(
      wait_for([&] { return !service->commands().empty() && service->commands().back().time > 1.2; }));
  EXPECT_FALSE(serving.over());
  EXPECT_FALSE(serving.stop());
  EXPECT_TRUE(tick.last.ready);
}

TEST_P(Haply, shows_no_force_while_it_is_not_calibrated) {
  const auto service = emulator(GetParam(), {{HaplyFaultKind::uncalibrated, 0.0, 0.5}});
  const auto device = open_at(service->port());
  Steady tick({0.25, 0.0, 0.0});
  Serving serving(*device, tick);
  ASSERT_TRUE(
      wait_for([&] { return !service->commands().empty() && service->commands().back().time > 1.0; }));
  EXPECT_FALSE(serving.stop());
  bool shown = false;
  for (const HaplyCommand& command : service->commands()) {
    if (command.time < 0.5) {
      EXPECT_EQ(command.force, Vec3(0.0, 0.0, 0.0)) << command.time;
    }
    shown |= command.force.x() == 0.25;
  }
  EXPECT_TRUE(shown);
}

TEST_P(Haply, is_lost_when_it_is_unplugged) {
  const auto service = emulator(GetParam(), {{HaplyFaultKind::unplugged, 0.2, 1e9}});
  const auto device = open_at(service->port());
  Steady tick({0.25, 0.0, 0.0});
  Serving serving(*device, tick);
  expect_one_sentence_with(serving.loss(), "no such Inverse3 any more");
  // Before it is given up the force is let go.
  EXPECT_EQ(service->commands().back().force, Vec3(0.0, 0.0, 0.0));
}

TEST_P(Haply, is_lost_when_the_service_falls_silent_or_goes) {
  {
    const auto service = emulator(GetParam(), {{HaplyFaultKind::silent, 0.2, 1e9}});
    const auto device = open_at(service->port());
    Steady tick;
    Serving serving(*device, tick);
    expect_one_sentence_with(serving.loss(), "silent for half a second");
  }
  auto service = emulator(GetParam());
  const auto device = open_at(service->port());
  Steady tick;
  Serving serving(*device, tick);
  ASSERT_TRUE(wait_for([&] { return tick.calls > 20; }));
  service.reset();
  expect_one_sentence_with(serving.loss(), "has closed the connection");
}

TEST_P(Haply, can_be_served_again) {
  const auto service = emulator(GetParam());
  const auto device = open_at(service->port());
  for (int i = 0; i < 2; ++i) {
    Steady tick;
    Serving serving(*device, tick);
    EXPECT_TRUE(wait_for([&] { return tick.calls > 20; }));
    EXPECT_FALSE(serving.stop());
  }
}

std::string refusal(const std::string& argument) {
  const Result<std::unique_ptr<Device>> device = open_haply(argument);
  EXPECT_FALSE(device) << argument;
  return device ? "" : device.error().sentence;
}

TEST(HaplyOpening, says_what_is_missing) {
  for (const char* port : {"0", "65536", "-1", "10001x", "here"})
    expect_one_sentence_with(refusal(port), "'" + std::string(port) + "' is no port");
  expect_one_sentence_with(refusal("1"), "cannot be reached");
  const auto service = emulator(Dialect::vector, {{HaplyFaultKind::unplugged, 0.0, 1e9}});
  expect_one_sentence_with(refusal(std::to_string(service->port())), "has no Inverse3");
}

// Plays the service's part of a transcript; what the client says is noted.
class Player {
 public:
  explicit Player(const std::string& file) {
    std::ifstream lines(file);
    EXPECT_TRUE(lines) << file;
    for (std::string line; std::getline(lines, line);) {
      if (line.starts_with("> ")) says_.push_back(line.substr(2));
      if (line.starts_with("< ")) expected_.push_back(line.substr(2));
    }
    net::WebService service;
    service.answer = [](const net::WebRequest&) { return net::WebAnswer(); };
    service.serve = [this](net::WebSocket& client, const auto& stopping) {
      std::string message;
      client.send(says_[0], 1.0);
      for (std::size_t next = 1; !stopping();) {
        const auto received = client.receive(message, 0.01);
        if (received == net::WebSocket::Received::closed) return;
        if (received != net::WebSocket::Received::message) continue;
        heard_.push_back(message);
        client.send(says_[next], 1.0);
        next = std::min(next + 1, says_.size() - 1);
      }
    };
    server_ = net::WebServer::start(0, std::move(service)).value();
  }

  unsigned short port() const { return server_->port(); }
  // All that was heard, when the client has gone.
  std::vector<std::string> heard() {
    server_.reset();
    return heard_;
  }
  const std::vector<std::string>& expected() const { return expected_; }

 private:
  std::vector<std::string> says_, expected_, heard_;
  std::unique_ptr<net::WebServer> server_;
};

// The messages and answers of a session, as in docs.haply.co for each version.
class HaplyTranscript : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Of, HaplyTranscript, testing::Values("3.1", "3.5"),
                         [](const auto& version) { return version.index == 0 ? "of_3_1" : "of_3_5"; });

TEST_P(HaplyTranscript, is_spoken_word_for_word) {
  Player service(ACUS_SOURCE_DIR "/tests/fixtures/haply/" + std::string(GetParam()) + ".txt");
  const auto device = open_at(service.port());
  Steady tick({0.5, 0.0, -0.25});
  {
    Serving serving(*device, tick);
    ASSERT_TRUE(wait_for([&] { return tick.calls >= 20; }));
    EXPECT_FALSE(serving.stop());
  }
  EXPECT_EQ(tick.last.position, Vec3(0.081, -0.1475, 0.143));
  EXPECT_EQ(tick.last.buttons, 0b10U);
  const std::vector<std::string> heard = service.heard();
  ASSERT_GE(heard.size(), service.expected().size());
  EXPECT_EQ(heard.front(), service.expected().front());
  EXPECT_EQ(heard.back(), service.expected().back());
  // Not line by line: a reply that this machine delivers late is asked for again.
  const std::set<std::string> words(heard.begin(), heard.end());
  EXPECT_EQ(words, std::set<std::string>(service.expected().begin(), service.expected().end()));
}

// What the emulator sends is as deep and named as what the documentation shows.
TEST(HaplyEmulatorItself, obeys_only_the_words_of_its_version) {
  for (const Dialect dialect : {Dialect::values, Dialect::vector}) {
    const auto service = emulator(dialect);
    const auto socket = net::WebSocket::connect("127.0.0.1", service->port(), 5.0);
    ASSERT_TRUE(socket);
    std::string message;
    ASSERT_EQ((*socket)->receive(message, 5.0), net::WebSocket::Received::message);
    EXPECT_EQ(message.find("\"session_id\"") != std::string::npos, dialect == Dialect::vector);
    haply::Inventory known;
    ASSERT_FALSE(haply::read_message(message, known));
    EXPECT_EQ(known.dialect, dialect);
    for (const Dialect spoken : {Dialect::values, Dialect::vector}) {
      known.dialect = spoken;
      ASSERT_TRUE((*socket)->send(haply::force_message(known, {1.0, 2.0, 3.0}, false), 5.0));
      ASSERT_EQ((*socket)->receive(message, 5.0), net::WebSocket::Received::message);
    }
    ASSERT_EQ(service->commands().size(), 1U);
    EXPECT_EQ(service->came(), 1);
    EXPECT_EQ(service->commands()[0].force, Vec3(1.0, 2.0, 3.0));
  }
}

TEST(HaplyFaults, are_read_or_refused) {
  const Result<HaplyFault> fault = haply_fault("late@3:0.5");
  ASSERT_TRUE(fault);
  EXPECT_EQ(fault->kind, HaplyFaultKind::late);
  EXPECT_EQ(fault->from, 3.0);
  EXPECT_EQ(fault->to, 3.5);
  EXPECT_EQ(haply_fault("unplugged@1")->to, 2.0);
  for (const char* text : {"", "late", "late@", "late@x", "late@1:", "late@1:0", "late@-1", "late@1:2x",
                           "tired@1", "late@nan", "late@1:inf"})
    EXPECT_FALSE(haply_fault(text)) << text;
}

}  // namespace
}  // namespace acus::haptics
