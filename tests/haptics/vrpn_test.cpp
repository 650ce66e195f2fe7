// The VRPN backend against a server made of VRPN's own parts (vrpn_server.h): numbers arrive and leave as
// they are, and however a session ends, it ends without force.
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "acus/haptics/backends.h"
#include "acus/haptics/vrpn_address.h"
#include "acus/haptics/vrpn_device.h"
#include "serving.h"
#include "vrpn_server.h"

namespace acus::haptics {
namespace {

std::unique_ptr<Device> open(const VrpnServer& server) {
  Result<std::unique_ptr<Device>> device = open_vrpn(server.address());
  if (device) return std::move(device).value();
  ADD_FAILURE() << device.error().sentence;
  return nullptr;
}

std::string refusal(const std::string& argument) {
  const Result<std::unique_ptr<Device>> device = open_vrpn(argument);
  return device ? "" : device.error().sentence;
}

Vec3 vec(const std::array<float, 3>& v) { return Vec3(v[0], v[1], v[2]); }
Vec3 vec(const std::array<double, 3>& v) { return Vec3(v.data()); }

bool wait_for_force(const VrpnServer& server, const Vec3& force) {
  return wait_for([&] { return vec(server.last_field().force) == force; });
}

void expect_let_go(const VrpnServer& server) {
  EXPECT_TRUE(wait_for([&] { return server.last_field().radius == 0.0F; }));
  EXPECT_EQ(vec(server.last_field().force), Vec3::Zero().eval());
}

// What a device said in each tick; the same force whatever it says.
class Keeping final : public Tick {
 public:
  explicit Keeping(const Vec3& force = Vec3::Zero()) : force_(force) {}
  Wrench operator()(const DeviceState& state) noexcept override {
    const std::lock_guard lock(guard_);
    said_.push_back(state);
    return {force_, Vec3::Zero()};
  }
  std::vector<DeviceState> said() const {
    const std::lock_guard lock(guard_);
    return said_;
  }

 private:
  mutable std::mutex guard_;
  std::vector<DeviceState> said_;
  Vec3 force_;
};

TEST(Vrpn, says_where_the_handle_is) {
  VrpnServer server("Phantom0");
  HandlePose pose;
  pose.position = {0.01, -0.02, 0.03};
  pose.velocity = {0.1, 0.2, -0.3};
  pose.turn = {0.5, 0.5, 0.5, 0.5};  // x goes to y, y to z, z to x
  server.pose(pose);
  const auto device = open(server);
  ASSERT_TRUE(device);
  Steady tick;
  Serving serving(*device, tick);
  ASSERT_TRUE(wait_for([&] { return tick.calls >= 50; }));
  EXPECT_FALSE(serving.stop().has_value());
  EXPECT_EQ(tick.last.position, Vec3(0.01, -0.02, 0.03));
  EXPECT_EQ(tick.last.velocity, Vec3(0.1, 0.2, -0.3));
  EXPECT_LT((tick.last.orientation * Vec3::UnitX() - Vec3::UnitY()).norm(), 1e-15);
  EXPECT_LT((tick.last.orientation * Vec3::UnitY() - Vec3::UnitZ()).norm(), 1e-15);
  EXPECT_TRUE(tick.last.ready);
  EXPECT_TRUE(tick.time_goes_on);
}

TEST(Vrpn, ticks_once_for_each_report) {
  VrpnServer server("Phantom0");
  const auto device = open(server);
  ASSERT_TRUE(device);
  server.glide({0.0, 0.0, -1.0});  // a millimetre in each report
  Keeping tick;
  Serving serving(*device, tick);
  ASSERT_TRUE(wait_for([&] { return tick.said().size() >= 200; }));
  serving.stop();
  const std::vector<DeviceState> said = tick.said();
  int steps = 0;
  for (std::size_t i = 1; i < said.size(); ++i) {
    if (!said[i].ready || !said[i - 1].ready) continue;  // whoever shares the processor stalled the server
    const Vec3 step = said[i].position - said[i - 1].position;
    EXPECT_NEAR(step.z(), said[i - 1].position.z() == 0.0 && step.z() == 0.0 ? 0.0 : -1e-3, 1e-12) << i;
    ++steps;
  }
  EXPECT_GT(steps, 100);
}

TEST(Vrpn, finds_the_speed_where_the_server_says_none) {
  VrpnServer server("Phantom0");
  HandlePose mute;
  mute.says_velocity = false;
  server.pose(mute);
  const auto device = open(server);
  ASSERT_TRUE(device);
  server.glide({0.0, 0.2, 0.0});
  Keeping tick;
  Serving serving(*device, tick);
  ASSERT_TRUE(wait_for([&] { return tick.said().size() >= 500; }));
  serving.stop();
  // 0.2 mm in each report, and by the server's clock a report comes every millisecond or later.
  double fastest = 0.0;
  for (const DeviceState& state : tick.said()) fastest = std::max(fastest, state.velocity.y());
  EXPECT_GT(fastest, 0.1);
  EXPECT_LT(fastest, 0.2 * 1.01);
}

TEST(Vrpn, puts_out_exactly_the_force_of_tick_where_the_handle_is) {
  VrpnServer server("Phantom0");
  HandlePose pose;
  pose.position = {0.25, -0.5, 0.125};
  server.pose(pose);
  const auto device = open(server);
  ASSERT_TRUE(device);
  Steady tick(Vec3(1.25, -0.5, 0.75));
  Serving serving(*device, tick);
  ASSERT_TRUE(wait_for_force(server, Vec3(1.25, -0.5, 0.75)));
  const ForceField field = server.last_field();
  EXPECT_EQ(vec(field.origin), Vec3(0.25, -0.5, 0.125));
  EXPECT_EQ(field.jacobian, (std::array<float, 9>{}));
  EXPECT_GT(field.radius, 0.01F);
  EXPECT_LT(field.radius, 0.1F);
}

TEST(Vrpn, spring_brings_the_hand_to_rest_between_the_two_anchors) {
  VrpnServer server("Phantom0");
  const double of_hand = 200.0, of_tick = 100.0;  // N/m
  const Vec3 goal(0.0, 0.05, 0.02), anchor(0.01, -0.03, 0.0);
  server.send_hand(of_hand, {goal.x(), goal.y(), goal.z()});
  const auto device = open(server);
  ASSERT_TRUE(device);
  Spring tick(of_tick, anchor);
  Serving serving(*device, tick);
  // Hooke: the two springs pull as strongly as each other.
  const Vec3 rest = (of_hand * goal + of_tick * anchor) / (of_hand + of_tick);
  EXPECT_TRUE(wait_for([&] {
    return (vec(server.position()) - rest).norm() < 1e-6 &&
           (vec(server.last_field().force) - of_hand * (rest - goal)).norm() < 1e-3;
  }));
}

TEST(Vrpn, tells_the_buttons_also_those_that_were_down_before) {
  VrpnServer server("Phantom0");
  server.press(1, true);
  const auto device = open(server);
  ASSERT_TRUE(device);
  Keeping tick;
  Serving serving(*device, tick);
  const auto down = [&] {
    const std::vector<DeviceState> said = tick.said();
    return said.empty() ? 0U : said.back().buttons;
  };
  EXPECT_TRUE(wait_for([&] { return down() == 2U; }));
  server.press(0, true);
  EXPECT_TRUE(wait_for([&] { return down() == 3U; }));
  server.press(1, false);
  EXPECT_TRUE(wait_for([&] { return down() == 1U; }));
}

TEST(Vrpn, stop_takes_the_force_away_and_the_device_can_be_served_again) {
  VrpnServer server("Phantom0");
  const auto device = open(server);
  ASSERT_TRUE(device);
  for (int session = 0; session < 2; ++session) {
    Steady tick(Vec3(0.0, 2.0, 0.0));
    Serving serving(*device, tick);
    ASSERT_TRUE(wait_for_force(server, Vec3(0.0, 2.0, 0.0)));
    EXPECT_FALSE(serving.stop().has_value());
    expect_let_go(server);
  }
}

// A tracker falls silent while the hand feels a force, and the force goes.
class SilentVrpn : public testing::Test {
 protected:
  void SetUp() override {
    ASSERT_TRUE(device);
    serving.emplace(*device, tick);
    ASSERT_TRUE(wait_for_force(server, felt));
    server.be_silent(true);
    ASSERT_TRUE(wait_for_force(server, Vec3::Zero()));
  }

  const Vec3 felt{0.0, 2.0, 0.0};
  VrpnServer server{"Phantom0"};
  const std::unique_ptr<Device> device = open(server);
  Keeping tick{felt};
  std::optional<Serving> serving;
};

// Not ready after 50 ms, and lost after half a second.
TEST_F(SilentVrpn, is_lost) {
  expect_one_sentence_with(serving->loss(), "silent for half a second");
  expect_let_go(server);
  double heard = 0.0;
  for (const DeviceState& state : tick.said())
    if (state.ready)
      heard = state.time;
    else
      EXPECT_GT(state.time - heard, 0.05);
  EXPECT_GT(tick.said().back().time - heard, 0.4);
  EXPECT_FALSE(tick.said().back().ready);
}

TEST_F(SilentVrpn, is_only_a_device_that_was_not_ready_when_it_soon_speaks_again) {
  server.be_silent(false);
  EXPECT_TRUE(wait_for_force(server, felt) || serving->over());
}

TEST(Vrpn, server_that_ends_is_noticed) {
  VrpnServer server("Phantom0");
  const auto device = open(server);
  ASSERT_TRUE(device);
  Steady tick;
  Serving serving(*device, tick);
  ASSERT_TRUE(wait_for([&] { return tick.calls > 0; }));
  server.stop();
  expect_one_sentence_with(serving.loss(), "the device was lost");
  Steady never;
  Serving again(*device, never);
  expect_one_sentence_with(again.loss(), "the device was lost");
}

TEST(Vrpn, limits_are_the_most_cautious_that_we_know) {
  VrpnServer server("Phantom0");
  const auto device = open(server);
  ASSERT_TRUE(device);
  EXPECT_EQ(device->limits().name, "vrpn");
  EXPECT_EQ(device->limits().forward, Vec3(0.0, 0.0, -1.0));
  for (const DeviceLimits& row : known_devices()) {
    EXPECT_LE(device->limits().peak_force, row.peak_force) << row.name;
    EXPECT_LE(device->limits().continuous_force, row.continuous_force) << row.name;
    EXPECT_LE(device->limits().stiffness, row.stiffness) << row.name;
    EXPECT_LE(device->limits().coulomb, row.coulomb) << row.name;
    EXPECT_LE(device->limits().viscous, row.viscous) << row.name;
    EXPECT_GE(device->limits().delay, row.delay) << row.name;
  }
}

TEST(Vrpn, is_opened_by_its_name) {
  VrpnServer server("Phantom0");
  const Result<OpenDevice> device = open_device("vrpn:" + server.address());
  ASSERT_TRUE(device.ok()) << device.error().sentence;
  EXPECT_EQ(vrpn_missing(), "");
}

TEST(Vrpn, refusal_says_why) {
  VrpnServer server("Phantom0");
  const std::string at = "@127.0.0.1:" + std::to_string(server.port());
  expect_one_sentence_with(refusal("Phantom1" + at), "does not say where a tracker 'Phantom1' is");
  server.stop();
  expect_one_sentence_with(refusal("Phantom0" + at), "no VRPN server answers at 127.0.0.1:");
  expect_one_sentence_with(refusal("Phantom0@no-such-machine.invalid"),
                           "there is no machine 'no-such-machine.invalid'");
}

// Whoever answers there says nothing that VRPN would.
TEST(Vrpn, another_kind_of_server_is_refused_in_a_few_seconds) {
  const int listening = socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in at{};
  at.sin_family = AF_INET;
  at.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof at;
  ASSERT_EQ(bind(listening, reinterpret_cast<sockaddr*>(&at), size), 0);
  ASSERT_EQ(getsockname(listening, reinterpret_cast<sockaddr*>(&at), &size), 0);
  ASSERT_EQ(listen(listening, 5), 0);
  expect_one_sentence_with(refusal("Phantom0@127.0.0.1:" + std::to_string(ntohs(at.sin_port))),
                           "is no VRPN server");
  close(listening);
}

TEST(VrpnAddress, is_a_name_a_host_and_perhaps_a_port) {
  const Result<VrpnAddress> short_form = parse_vrpn_address("Phantom0@localhost");
  ASSERT_TRUE(short_form.ok());
  EXPECT_EQ(short_form->name, "Phantom0");
  EXPECT_EQ(server_of(*short_form), "localhost:3883");
  const Result<VrpnAddress> long_form = parse_vrpn_address("a@b@10.0.0.7:4000");
  ASSERT_TRUE(long_form.ok());
  EXPECT_EQ(long_form->name, "a@b");
  EXPECT_EQ(server_of(*long_form), "10.0.0.7:4000");
  // The last few are VRPN's own: a file that is played back, a program that is started on another machine.
  for (const char* wrong :
       {"", "Phantom0", "@localhost", "Phantom0@", "Phantom0@localhost:", "Phantom0@localhost:0",
        "Phantom0@localhost:65536", "Phantom0@localhost:99999999999", "Phantom0@local host",
        "Phantom0@file:/tmp/x", "Phantom0@x-vrsh://host/program", "Phantom0@tcp://host"}) {
    const Result<VrpnAddress> refused = parse_vrpn_address(wrong);
    ASSERT_FALSE(refused.ok()) << wrong;
    expect_one_sentence_with(refused.error().sentence, "vrpn:NAME@HOST");
  }
}

}  // namespace
}  // namespace acus::haptics
