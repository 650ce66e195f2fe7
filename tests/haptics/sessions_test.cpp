// Hundreds of sessions drawn at random: every device, every hand, everything that happens to a needle and to
// a loop. ACUS_SESSIONS says how many, ACUS_FIRST from which on; ACUS_SESSION runs the one of that number and
// says what became of it.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <sstream>
#include <string>

#include "virtual_session.h"

namespace acus::haptics {
namespace {

enum class Happening {
  nothing,
  withdrawal,
  hand_lets_go,
  reload,
  other_needle,
  replug,
  short_stall,
  long_stall
};
constexpr std::array happening_names{"nothing",      "withdrawal", "hand_lets_go", "reload",
                                     "other_needle", "replug",     "short_stall",  "long_stall"};

struct Session {
  Trial trial;
  Happening happening = Happening::nothing;
  std::string words;
};

double any_between(std::mt19937& random, double low, double high) {
  return low + (high - low) * (static_cast<double>(random()) / 4294967296.0);
}

double around(std::mt19937& random, double value) { return value * std::exp(any_between(random, -0.7, 0.7)); }

// Devices and happenings take turns, so that a few hundred sessions hold every pair of them several times.
Session session_of(unsigned number) {
  std::mt19937 random(number + 1);
  const auto any = [&](double low, double high) { return any_between(random, low, high); };
  const auto& devices = known_devices();
  Session s;
  Trial& t = s.trial;
  t.device = devices[number % devices.size()];
  s.happening = static_cast<Happening>(number / devices.size() % happening_names.size());
  const HandModel of_a_kind = random() % 2 == 0 ? light_grip : whole_arm;
  t.hand = {around(random, of_a_kind.mass), around(random, of_a_kind.damping),
            around(random, of_a_kind.stiffness)};
  const std::array periods{1e-3, 2e-3, 5e-3, 10e-3, 20e-3, 33e-3};  // s: 1 kHz to 30 Hz
  t.period = periods[random() % periods.size()];
  t.jitter = any(0.0, 0.3);
  t.seed = number;

  t.scene.needle_model = NeedleModel::column;  // whose step may be as long as the slowest word
  t.scene.needle.length = any(0.1, 0.3);
  t.scene.contact.rupture_force = any(0.3, 1.2);
  t.scene.tissue.tetrahedra = 200;
  t.scene.run.time_step = std::min(t.period, 20e-3);  // beyond, needle and tissue go slower than the clock
  t.another = t.scene;
  if (s.happening == Happening::other_needle) t.another->needle.length = any(0.1, 0.3);
  if (s.happening == Happening::reload) t.another->tissue.youngs_modulus *= any(0.5, 2.0);

  const double speed = any(0.05, 0.5), depth = any(7e-3, 45e-3), moment = 1.7 + any(0.0, 0.1);
  const bool comes_back = s.happening == Happening::withdrawal;
  t.plan = [=](double time) {
    const double there = std::clamp(speed * (time - 0.8), 0.0, depth);
    return comes_back ? std::max(there - std::max(speed * (time - moment), 0.0), -2e-3) : there;
  };
  t.duration = 4.8;
  if (s.happening == Happening::hand_lets_go) t.lets_go = moment;
  if (s.happening == Happening::reload || s.happening == Happening::other_needle) t.reload = moment;
  if (s.happening == Happening::replug) t.unplugged = moment;
  if (s.happening == Happening::short_stall) t.stalls = moment, t.stall_time = any(0.0, 48e-3 - t.period);
  if (s.happening == Happening::long_stall) t.stalls = moment, t.stall_time = any(100e-3, 500e-3);

  std::ostringstream words;
  words << "session " << number << ": " << t.device.name << ", hand " << t.hand.mass << " kg "
        << t.hand.damping << " N s/m " << t.hand.stiffness << " N/m, word every " << 1e3 * t.period
        << " ms, needle " << 1e3 * t.scene.needle.length << " mm, ruptures at "
        << t.scene.contact.rupture_force << " N, " << speed << " m/s to " << 1e3 * depth << " mm, "
        << happening_names[static_cast<std::size_t>(s.happening)];
  s.words = words.str();
  return s;
}

void expect_well(const Session& s, const Finding& found) {
  const DeviceLimits& device = s.trial.device;
  EXPECT_TRUE(found.finite);
  EXPECT_EQ(found.frame.health, Health::good);
  EXPECT_LE(found.largest_force, device.peak_force * (1.0 + 1e-12));
  EXPECT_LE(found.largest_rise, 0.5 + 1e-12);
  EXPECT_LE(found.largest_fall, 1.0 + 1e-12);
  EXPECT_GE(found.least_port_energy, -1e-6);
  EXPECT_LE(found.limit_cycle, 0.1e-3);
  EXPECT_LT(found.top_speed, 1.2);
  EXPECT_EQ(found.fault, GateFault::none);
  EXPECT_EQ(found.faulted,
            s.happening == Happening::replug || s.happening == Happening::long_stall);  // and rearmed
  // With a simulation that keeps up, the hand at rest feels what the needle does. (After a fault in contact
  // the gate waits for a needle that hardly pushes; what another scene holds the hand has not put in.)
  const bool undisturbed = s.happening == Happening::nothing || s.happening == Happening::withdrawal ||
                           s.happening == Happening::short_stall;
  if (s.trial.period < 10e-3 && undisturbed) {
    EXPECT_NEAR(found.last_force, std::abs(found.frame.hand_force), 0.05);
  }
  if (s.happening == Happening::long_stall) {
    EXPECT_LT(found.longest_force_after_stall, 0.1);
  }
}

long asked_for(const char* name, long otherwise) {
  const char* text = std::getenv(name);
  return text != nullptr ? std::atol(text) : otherwise;
}

TEST(Sessions, none_diverges_hums_or_gives_energy_away) {
  const long one = asked_for("ACUS_SESSION", -1), count = asked_for("ACUS_SESSIONS", 500);
  const long first = one >= 0 ? one : asked_for("ACUS_FIRST", 0), last = one >= 0 ? one : first + count - 1;
  long touched = 0, buckled = 0, punctured = 0;
  for (long i = first; i <= last; ++i) {
    const Session s = session_of(static_cast<unsigned>(i));
    SCOPED_TRACE(s.words);
    const Finding found = run(s.trial);
    expect_well(s, found);
    touched += found.touched, buckled += found.buckled, punctured += found.punctured;
    if (one >= 0)
      std::printf(
          "%s\nforce %.3f N, at the end %.3f N; needle %.3f N; travel %.1f mm; swing %.4f mm; energy %.3g "
          "J\n",
          s.words.c_str(), found.largest_force, found.last_force, found.frame.hand_force,
          1e3 * found.largest_travel, 1e3 * found.limit_cycle, found.least_port_energy);
  }
  if (one < 0) {
    EXPECT_GT(touched, count / 2);
    EXPECT_GT(buckled, count / 5);
    EXPECT_GT(punctured, count / 5);
  }
}

}  // namespace
}  // namespace acus::haptics
