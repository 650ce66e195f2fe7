// What the service's documentation shows, and what may go wrong with it.
#include "acus/haptics/haply_protocol.h"

#include <gtest/gtest.h>

namespace acus::haptics::haply {
namespace {

// As in "Simulation Channel", version 3.4, shortened in its config.
constexpr const char* inventory_34 = R"({"inverse3":[{"device_id":"04BA","config":{"type":"inverse3",
  "device_info":{"minor_version":1,"major_version":7,"id":"04BA","model":4},"handedness":"right"},
  "state":{"angular_position":{"a0":-69.31704,"a1":137.62952,"a2":19.832787},
  "body_orientation":{"x":-0.01940918,"y":0.7026367,"z":0.00048828125,"w":0.7113037},
  "cursor_position":{"x":0.07842738,"y":-0.14836666,"z":0.14297646},
  "cursor_velocity":{"x":-0.011969013,"y":0.0012009288,"z":-0.043197},"mode":"idle"},
  "status":{"calibrated":false,"in_use":false,"power_supply":true,"ready":true,"started":true}}],
  "verse_grip":[{"device_id":"61548","config":{"port":"COM3","type":"verse_grip"},"state":{"button":true,"hall":0,
  "orientation":{"x":0.0,"y":0.0,"z":0.70710678,"w":0.70710678}},"status":{"error":0}}]})";

// As in "WebSocket Protocol", version 3.5, shortened likewise.
constexpr const char* inventory_35 =
    R"({"session_id":7,"inverse3":[{"device_id":"049D","config":{"type":"inverse3",
  "port":"COM12","basis":{"permutation":"XYZ"}},"state":{"cursor_position":{"x":0.0,"y":-0.12,"z":0.15},
  "cursor_velocity":{"x":0.0,"y":0.0,"z":0.0},"control_mode":"idle"},"status":{"calibrated":true}}],
  "wireless_verse_grip":[{"device_id":"1","state":{"orientation":{"w":1,"x":0,"y":0,"z":0},
  "buttons":{"a":false,"b":true,"c":true}}}]})";

Inventory after(const std::string& first, const std::string& then = "{}") {
  Inventory known;
  for (const std::string& message : {first, then}) {
    const auto wrong = read_message(message, known);
    EXPECT_FALSE(wrong) << wrong->sentence;
  }
  return known;
}

TEST(HaplyProtocol, reads_the_inventory_of_3_4) {
  Inventory known;
  ASSERT_FALSE(read_message(inventory_34, known));
  EXPECT_EQ(known.device, "04BA");
  EXPECT_EQ(known.dialect, Dialect::values);
  EXPECT_TRUE(known.present);
  EXPECT_FALSE(known.calibrated);
  EXPECT_EQ(known.position, Vec3(0.07842738, -0.14836666, 0.14297646));
  EXPECT_EQ(known.velocity, Vec3(-0.011969013, 0.0012009288, -0.043197));
  EXPECT_EQ(known.buttons, 1U);
  EXPECT_LT((known.orientation * Vec3::UnitX() - Vec3::UnitY()).norm(), 1e-7);  // a quarter turn about z
}

TEST(HaplyProtocol, reads_the_inventory_of_3_5) {
  Inventory known;
  ASSERT_FALSE(read_message(inventory_35, known));
  EXPECT_EQ(known.device, "049D");
  EXPECT_EQ(known.dialect, Dialect::vector);
  EXPECT_TRUE(known.calibrated);
  EXPECT_EQ(known.position, Vec3(0.0, -0.12, 0.15));
  EXPECT_EQ(known.buttons, 0b110U);
  EXPECT_TRUE(known.orientation.isIdentity());
}

TEST(HaplyProtocol, asks_for_forces_as_each_version_wants_them) {
  Inventory known;
  known.device = "049D";
  EXPECT_EQ(
      force_message(known, {0.0, 0.0, 0.0}, true),
      R"({"session":{"configure":{"profile":{"name":"acus"}}},"inverse3":[{"device_id":"049D","commands":)"
      R"({"set_cursor_force":{"values":{"x":0,"y":0,"z":0}}}}]})");
  known.dialect = Dialect::vector;
  EXPECT_EQ(
      force_message(known, {0.25, -1.5, 1e-7}, false),
      R"({"inverse3":[{"device_id":"049D","commands":{"set_cursor_force":{"vector":{"x":0.25,"y":-1.5,"z":1.00000001e-07}}}}]})");
}

TEST(HaplyProtocol, keeps_what_a_partial_update_leaves_out) {
  const Inventory moved = after(inventory_35, R"({"inverse3":[{"device_id":"049D",
    "state":{"cursor_position":{"x":0.01,"y":0.02,"z":0.03}}}],
    "wireless_verse_grip":[{"state":{"buttons":{"a":true}}}]})");
  EXPECT_EQ(moved.position, Vec3(0.01, 0.02, 0.03));
  EXPECT_TRUE(moved.calibrated);
  EXPECT_TRUE(moved.present);
  EXPECT_EQ(moved.dialect, Dialect::vector);
  EXPECT_EQ(moved.buttons, 0b111U);
  const Inventory nothing =
      after(inventory_35, R"({"inverse3":[{"device_id":"049D","state":null,"status":{}}]})");
  EXPECT_TRUE(nothing.present);
  EXPECT_EQ(nothing.position, Vec3(0.0, -0.12, 0.15));
}

TEST(HaplyProtocol, follows_the_device_that_it_has_chosen) {
  const std::string two = R"({"inverse3":[{"device_id":"B","state":{"cursor_position":{"x":1,"y":1,"z":1}}},
    {"device_id":"049D","state":{"cursor_position":{"x":2,"y":2,"z":2}}}]})";
  EXPECT_EQ(after(two).device, "B");
  const Inventory known = after(inventory_35, two);
  EXPECT_EQ(known.device, "049D");
  EXPECT_EQ(known.position, Vec3(2.0, 2.0, 2.0));
}

TEST(HaplyProtocol, notices_that_the_device_has_gone) {
  EXPECT_FALSE(after(inventory_35, R"({"inverse3":[]})").present);
  EXPECT_FALSE(after(inventory_35, R"({"inverse3":[{"device_id":"other"}]})").present);
  EXPECT_FALSE(after(inventory_35, R"({"error":"device-disconnected"})").present);
}

TEST(HaplyProtocol, refuses_what_makes_no_sense_and_keeps_what_it_knew) {
  const std::string deep = R"({"inverse3":)" + std::string(100'000, '[') + std::string(100'000, ']') + "}";
  for (const std::string& message : {
           std::string(),
           std::string("force"),
           std::string("[1,2]"),
           std::string("\"text\""),
           std::string("null"),
           std::string(inventory_35).substr(0, 200),
           std::string(
               R"({"inverse3":[{"device_id":"049D","state":{"cursor_position":{"x":"0","y":0,"z":0}}}]})"),
           std::string(R"({"inverse3":[{"device_id":"049D","state":{"cursor_position":{"x":0,"z":0}}}]})"),
           std::string(
               R"({"inverse3":[{"device_id":"049D","state":{"cursor_position":{"x":1e999,"y":0,"z":0}}}]})"),
           std::string(R"({"inverse3":[{"device_id":"049D","state":{"cursor_position":[0,0,0]}}]})"),
           std::string(R"({"inverse3":[{"device_id":49}]})"),
           std::string(R"({"inverse3":[{"device_id":"a\"}]}"}]})"),
           std::string(R"({"inverse3":["049D"]})"),
       }) {
    Inventory known = after(inventory_35);
    known.present = true;
    const auto wrong = read_message(message, known);
    EXPECT_TRUE(wrong) << message.substr(0, 100);
    EXPECT_EQ(known.position, Vec3(0.0, -0.12, 0.15));
    EXPECT_TRUE(known.present);
    if (wrong) {
      EXPECT_EQ(wrong->sentence.find('\n'), std::string::npos);
    }
  }
  Inventory known;
  read_message(deep, known);  // neither goes deep nor knows a device
  EXPECT_TRUE(known.device.empty());
}

}  // namespace
}  // namespace acus::haptics::haply
