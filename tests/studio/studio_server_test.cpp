// Pages at the server, over real sockets: what they are told, who leads, and what a bad one cannot do.
#include <gtest/gtest.h>

#include <algorithm>
#include <thread>

#include "acus/haptics/simulated_device.h"
#include "acus/haptics/virtual_coupling.h"
#include "page.h"
#include "tests/net/raw_socket.h"

namespace acus::app {
namespace {

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

TEST(StudioServer, takes_a_long_message_and_not_many) {
  const Running server(led_engine(bare_column()));
  Page page(server);
  const json question = {{"type", "check"}, {"scene", std::string(900'000, '#')}};
  EXPECT_TRUE(page.say(question));
  page.next("expectation");
  for (int i = 0; i < 100; ++i)
    if (!page.say(question)) break;
  EXPECT_TRUE(page.closed());
}

TEST(StudioServer, counts_pings_as_messages) {
  const Running server(led_engine(bare_column()));
  const net::RawSocket raw(server.port());
  raw.write(net::socket_request(server.port(), server.token()));
  raw.read_to("\r\n\r\n");
  for (int i = 0; i < 1000 && raw.sends(net::ping_frame()); ++i) {
  }
  EXPECT_TRUE(raw.is_closed_within(long_enough));
}

// Who drags a slider asks faster than anybody can foretell.
TEST(StudioServer, answers_the_last_of_many_questions_in_a_row) {
  const Running server(led_engine(bare_column()));
  Page page(server);
  page.next("model");
  constexpr int questions = 100;
  for (int i = 1; i <= questions; ++i)
    page.say({{"type", "check"}, {"scene", "needle.length_mm = " + std::to_string(100 + i)}});
  const double last = 300.0;
  int answers = 0;
  double load = 0.0;
  page.say({{"type", "check"}, {"scene", "needle.length_mm = " + std::to_string(last)}});
  do {
    load = page.next("expectation")["critical_load_N"];
    ++answers;
  } while (std::abs(load - 0.2854) > 1e-3 && answers < questions);
  EXPECT_LT(answers, questions);
}

// Frames of a scene that is too heavy for this machine: it is slow, but the page is not.
TEST(StudioServer, shows_a_heavy_scene_in_slow_motion_and_not_in_jumps) {
  Scene heavy;
  heavy.tissue.tetrahedra = 20'000;
  const Running server(led_engine(heavy));
  Page page(server);
  constexpr std::size_t time = 0;
  std::vector<double> jumps;
  double before = page.number(time);
  for (int i = 0; i < 31; ++i) {
    const double now = page.number(time);
    jumps.push_back(now - before);
    before = now;
  }
  std::sort(jumps.begin(), jumps.end());
  EXPECT_LT(jumps[jumps.size() / 2], 0.05);  // s; a step is 1 ms, and takes several
  EXPECT_GT(before, 0.0);
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

bool is_let_go(const json& loop) { return loop["gate"] == "disarmed" && loop["device_force_N"] == 0.0; }

TEST(StudioServer, shows_a_device_and_takes_its_force_away) {
  const Running server(engine_with_device({2.0, {}}));
  Page page(server);
  EXPECT_EQ(page.next("hello")["device"], "3D Systems Touch (Phantom Omni)");
  json loop = page.next("loop");
  EXPECT_EQ(loop["force_limit_N"], 2.0);
  for (int i = 0; i < 300 && loop["device_force_N"] < 0.4; ++i) {
    page.say({{"type", "arm"}});  // again where a busy machine has cost the force
    loop = page.next("loop");
  }
  EXPECT_EQ(loop["gate"], "armed");
  page.say({{"type", "push"}, {"travel_m", 0.0}});
  EXPECT_NE(page.next("refused")["sentence"].get<std::string>().find("the device leads"), std::string::npos);
  page.say({{"type", "disarm"}});
  for (int i = 0; i < 300 && !is_let_go(loop); ++i) loop = page.next("loop");
  EXPECT_EQ(loop["device_force_N"], 0.0);
  EXPECT_EQ(loop["gate"], "disarmed");
  page.say({{"type", "start"}, {"scene", "tissue.rigid = true\nneedle.length_mm = 150"}});
  EXPECT_EQ(page.next("model")["needle_length_m"], 0.15);
}

TEST(StudioServer, lets_a_devices_force_go_when_the_page_that_armed_it_falls_silent) {
  const Running server(engine_with_device({}));
  Page silent(server), watching(server);
  json loop = watching.next("loop");
  for (int i = 0; i < 300 && loop["device_force_N"] < 0.3; ++i) {
    silent.say({{"type", "arm"}});  // again where a busy machine has cost the force
    loop = watching.next("loop");
  }
  EXPECT_GE(loop["device_force_N"], 0.3);
  for (int i = 0; i < 300 && !is_let_go(loop); ++i) loop = watching.next("loop");
  EXPECT_EQ(loop["device_force_N"], 0.0);
  EXPECT_EQ(loop["gate"], "disarmed");
}

TEST(StudioServer, tells_every_page_whether_time_stands_still) {
  for (const bool with_device : {false, true}) {
    const Running server(with_device ? engine_with_device({}) : led_engine(bare_column()));
    Page page(server), watching(server);
    const auto comes = [&](bool paused) {
      json loop = watching.next("loop");
      for (int i = 0; i < 100 && loop["paused"] != paused; ++i) loop = watching.next("loop");
      return loop["paused"] == paused;
    };
    EXPECT_TRUE(comes(false));
    page.say({{"type", "pause"}});
    EXPECT_TRUE(comes(true));
    page.say({{"type", "resume"}});
    EXPECT_TRUE(comes(false));
  }
}

TEST(StudioServer, lets_time_run_in_an_insertion_that_is_chosen_while_the_last_one_is_paused) {
  const Running server(engine_with_device({}));
  Page page(server);
  page.say({{"type", "pause"}});
  page.next("model");
  page.say({{"type", "start"}, {"scene", "tissue.rigid = true"}});
  page.next("model");
  constexpr std::size_t time = 0;
  double moment = 0.0;
  for (int i = 0; i < 1000 && moment < 0.05; ++i) moment = page.number(time);
  EXPECT_GE(moment, 0.05);
}

TEST(StudioServer, goes_on_with_another_insertion_after_one_that_failed) {
  const haptics::DeviceLimits& touch = *haptics::find_device_limits("touch");
  haptics::OpenDevice device{
      &haptics::backends()[0],
      std::make_unique<haptics::SimulatedDevice>(touch, haptics::light_grip, [](double) { return 0.0; })};
  Simulation failed = Simulation::build(haptics::held_by(touch, bare_column())).value();
  failed.step(std::nan(""));
  const Running server(device_engine(std::move(device), std::move(failed), {}));
  Page page(server);
  page.next("failed");
  page.say({{"type", "start"}, {"scene", "tissue.rigid = true\nneedle.length_mm = 150"}});
  EXPECT_EQ(page.next("model")["needle_length_m"], 0.15);
}

// A device that is unplugged at once.
class Lost final : public haptics::Device {
 public:
  const haptics::DeviceLimits& limits() const override { return *haptics::find_device_limits("touch"); }
  std::optional<Error> serve(haptics::Tick&, const std::atomic<bool>&) override {
    return Error{"the device was lost"};
  }
};

TEST(StudioServer, ends_by_itself_when_the_device_is_lost) {
  const auto engine = device_engine({&haptics::backends()[0], std::make_unique<Lost>()},
                                    Simulation::build(bare_column()).value(), {});
  const auto server = StudioServer::start(0, *engine).value();
  const std::atomic<bool> never{false};
  const std::optional<Error> failed = server->run(never);
  ASSERT_TRUE(failed);
  EXPECT_EQ(failed->sentence, "the device was lost");
}

}  // namespace
}  // namespace acus::app
