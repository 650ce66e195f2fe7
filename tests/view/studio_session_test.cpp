#include "acus/view/studio_session.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/view/small_scene.h"

namespace acus::view {
namespace {

using Json = nlohmann::json;

class Session : public ::testing::Test {
 protected:
  Session() { reports(); }

  void send(const Json& command) { session.take(command.dump()); }
  std::vector<Json> reports() {
    std::vector<Json> all;
    while (const auto text = session.next_report()) all.push_back(Json::parse(*text));
    return all;
  }
  std::string refusal() {
    const auto all = reports();
    return all.size() == 1 && all[0]["type"] == "refused" ? all[0]["sentence"].get<std::string>()
                                                          : "not refused";
  }
  void start(const std::vector<std::string>& settings = {}) {
    send({{"type", "start"}, {"scene", small_scene}, {"settings", settings}});
    const auto all = reports();
    ASSERT_EQ(all.size(), 1U);
    ASSERT_EQ(all[0]["type"], "model") << all[0];
  }
  double time() const { return session.simulation()->frame().time; }
  double travel() const { return session.simulation()->frame().hand_travel; }

  StudioSession session{{"wasm", std::nullopt, build_without_files}};
};

TEST_F(Session, says_hello_first) {
  StudioSession fresh({"wasm", std::nullopt, build_without_files});
  EXPECT_EQ(Json::parse(*fresh.next_report())["type"], "hello");
  EXPECT_FALSE(fresh.next_report());
}

TEST_F(Session, shows_and_moves_nothing_before_the_first_start) {
  EXPECT_TRUE(session.frame().empty());
  EXPECT_EQ(session.advance(1.0), 0);
  send({{"type", "push"}, {"travel_m", 0.01}});
  EXPECT_NE(refusal().find("start one first"), std::string::npos);
}

TEST_F(Session, steps_in_the_scenes_own_time) {
  start();
  EXPECT_EQ(session.advance(0.0205), 20);
  EXPECT_EQ(session.advance(0.0005), 1);
  EXPECT_NEAR(time(), 0.021, 1e-9);
  EXPECT_EQ(session.advance(-1.0), 0);
  EXPECT_EQ(session.advance(NAN), 0);
}

TEST_F(Session, goes_into_slow_motion_when_too_much_is_due) {
  start();
  EXPECT_EQ(session.advance(0.5, 10), 10);
  EXPECT_EQ(session.advance(0.0, 10), 0);  // what was due is not made up for
  EXPECT_EQ(session.advance(0.0051, 10), 5);
}

TEST_F(Session, rate_slows_time_down) {
  start();
  send({{"type", "rate"}, {"factor", 0.1}});
  EXPECT_EQ(session.advance(0.0505), 5);
  send({{"type", "rate"}, {"factor", 1.5}});
  EXPECT_NE(refusal().find("factor"), std::string::npos);
}

TEST_F(Session, stands_still_while_paused_but_for_single_steps) {
  start();
  send({{"type", "step"}, {"steps", 2}});
  EXPECT_NE(refusal().find("pause it first"), std::string::npos);
  send({{"type", "pause"}});
  EXPECT_EQ(session.advance(0.1), 0);
  send({{"type", "step"}, {"steps", 3}});
  EXPECT_EQ(session.advance(0.001, 2), 2);
  EXPECT_EQ(session.advance(0.001, 2), 1);
  EXPECT_EQ(session.advance(0.1), 0);
  send({{"type", "resume"}});
  EXPECT_EQ(session.advance(0.0101), 10);
}

TEST_F(Session, push_leads_the_hub_at_five_times_the_scenes_speed) {
  start();
  send({{"type", "push"}, {"travel_m", 0.004}});
  session.advance(0.0205);  // at 5 x 20 mm/s
  EXPECT_NEAR(travel(), 0.002, 1e-9);
  session.advance(0.05);
  EXPECT_NEAR(travel(), 0.004, 1e-9);
}

TEST_F(Session, refused_start_leaves_the_insertion_as_it_was) {
  start();
  send({{"type", "steady"}, {"speed_m_s", 0.02}});
  session.advance(0.0105);
  reports();
  const double before = travel();
  send({{"type", "start"}, {"scene", "[needle]\nlenght_mm = 3"}});
  EXPECT_EQ(refusal(),
            "scene:2:13: needle.lenght_mm is not a key of a scene; did you mean needle.length_mm?");
  send({{"type", "start"}, {"scene", small_scene}, {"settings", {"needle.length_mm=1e9"}}});
  EXPECT_EQ(refusal(), "needle.length_mm must be from 1 to 2000, but is 1000000000");
  send({{"type", "start"}, {"scene", small_scene}, {"settings", {"tissue.mesh=liver.msh"}}});
  EXPECT_NE(refusal().find("tissue.mesh names a file"), std::string::npos);
  EXPECT_EQ(travel(), before);
  session.advance(0.01);
  EXPECT_NEAR(travel(), 2.0 * before, 1e-9);
}

TEST_F(Session, second_start_begins_anew) {
  start();
  send({{"type", "steady"}, {"speed_m_s", 0.02}});
  session.advance(0.1);
  send({{"type", "pause"}});
  reports();
  start({"tissue.tetrahedra=200"});
  EXPECT_EQ(time(), 0.0);
  EXPECT_EQ(session.advance(0.0105), 10);
  EXPECT_EQ(travel(), 0.0);  // the new hand rests
}

TEST_F(Session, check_answers_and_the_insertion_goes_on) {
  start();
  send({{"type", "check"}, {"scene", small_scene}, {"settings", {"contact.rupture_force_N=2"}}});
  const auto all = reports();
  ASSERT_EQ(all.size(), 1U);
  EXPECT_EQ(all[0]["type"], "expectation");
  EXPECT_EQ(all[0]["outcome"], "never_punctured");
  EXPECT_EQ(session.advance(0.0105), 10);
  send({{"type", "check"}, {"scene", "="}});
  EXPECT_NE(refusal().find("is not TOML"), std::string::npos);
}

TEST_F(Session, has_no_device_to_arm) {
  send({{"type", "arm"}});
  EXPECT_NE(refusal().find("no device"), std::string::npos);
  send({{"type", "disarm"}});
  EXPECT_NE(refusal().find("no device"), std::string::npos);
}

TEST_F(Session, tells_events_once_and_in_order) {
  start();
  send({{"type", "steady"}, {"speed_m_s", 0.1}});
  session.advance(0.1005);
  const auto all = reports();
  ASSERT_GE(all.size(), 2U);
  EXPECT_EQ(all[0]["event"], "contact");
  EXPECT_EQ(all[1]["event"], "puncture");  // so fast that the bow comes later
  EXPECT_EQ(all.size(), session.simulation()->events().size());
  EXPECT_TRUE(reports().empty());
}

// A needle that never goes in folds over where the hand does not stop.
TEST_F(Session, an_insertion_that_fails_says_so_once_and_takes_no_more_orders) {
  start({"tissue.rigid=true", "needle.length_mm=50"});
  send({{"type", "steady"}, {"speed_m_s", 0.5}});
  for (int i = 0; i < 20; ++i) session.advance(0.01);
  int failures = 0;
  for (const Json& report : reports()) failures += report["type"] == "failed";
  EXPECT_EQ(failures, 1);
  EXPECT_EQ(session.advance(0.01), 0);
  send({{"type", "steady"}, {"speed_m_s", 0.0}});
  EXPECT_NE(refusal().find("has ended"), std::string::npos);
  start();
  EXPECT_EQ(session.advance(0.0105), 10);
}

TEST_F(Session, a_page_that_never_listens_does_not_fill_the_memory) {
  for (int i = 0; i < 20000; ++i) session.take("nonsense");
  EXPECT_LE(reports().size(), 10000U);
}

}  // namespace
}  // namespace acus::view
