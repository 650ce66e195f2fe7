// A person's hand against springs of our own, where closed forms say what must come.
#include "acus/sim/person.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <vector>

#include "acus/sim/hand.h"
#include "acus/sim/simulation.h"
#include "acus/sim/tremor.h"

namespace acus {
namespace {

constexpr double ms = 1e-3;  // s

// A hand that does nothing but push.
HandScene pusher() {
  HandScene hand;
  hand.kind = HandKind::person;
  hand.speed = 20e-3;
  hand.force_limit = 3.0;
  hand.hesitation = hand.tremor = 0.0;
  hand.duration = 20.0;
  return hand;
}

using World = std::function<double(double travel)>;  // the force on the hand there, N

struct Trial {
  std::vector<double> time, travel, force;

  double at(const std::vector<double>& values, double t) const {
    for (std::size_t i = 1; i < time.size(); ++i)
      if (time[i] >= t - 1e-9)
        return values[i - 1] + (values[i] - values[i - 1]) * (t - time[i - 1]) / (time[i] - time[i - 1]);
    return values.back();
  }
  // When the force first comes to that, between the steps. s
  double first(double wanted) const {
    for (std::size_t i = 1; i < time.size(); ++i)
      if (force[i] >= wanted)
        return time[i] - (time[i] - time[i - 1]) * (force[i] - wanted) / (force[i] - force[i - 1]);
    return INFINITY;
  }
  // When the force falls most from one step to the next. s
  double drop() const {
    std::size_t found = 1;
    for (std::size_t i = 1; i < time.size(); ++i)
      if (force[i] - force[i - 1] < force[found] - force[found - 1]) found = i;
    return time[found];
  }
};

Trial tried(const HandScene& scene, World world, double step = ms) {
  Hand hand(scene, step);
  Trial trial{{0.0}, {0.0}, {world(0.0)}};
  while (const auto travel = hand.next(trial.force.back())) {
    trial.time.push_back(static_cast<double>(trial.time.size()) * step);
    trial.travel.push_back(*travel);
    trial.force.push_back(world(*travel));
  }
  return trial;
}

World wall(double stiffness, double from = 0.0) {
  return [=](double travel) { return stiffness * std::max(travel - from, 0.0); };
}

// A wall that breaks once under `strength`; what is behind it holds `left`, and no more.
World skin(double stiffness, double from, double strength, double left) {
  return [=, broken = false](double travel) mutable {
    const double force = stiffness * std::max(travel - from, 0.0);
    broken = broken || force >= strength;
    return broken ? left : force;
  };
}

// Hill's law against a spring: dF/dt = K v0 (1 - f) / (1 + 4 f), so t = F0 / (K v0) (-5 ln(1 - f) - 4 f).
double time_to(double share, double stiffness, const HandScene& hand) {
  return hand.force_limit / (stiffness * hand.speed) * (-5.0 * std::log(1.0 - share) - 4.0 * share);
}

TEST(Person, push_against_a_wall_rises_as_hills_law_says_and_never_passes_the_limit) {
  const HandScene hand = pusher();
  for (double stiffness : {300.0, 1000.0, 5000.0}) {
    const Trial trial = tried(hand, wall(stiffness), 0.1 * ms);
    for (double share : {0.2, 0.5, 0.9, 0.99}) {
      const double exact = time_to(share, stiffness, hand);
      EXPECT_NEAR(trial.first(share * hand.force_limit), exact, 1.5 * ms) << stiffness << " N/m, " << share;
    }
    for (double force : trial.force) ASSERT_LE(force, hand.force_limit);
    EXPECT_NEAR(trial.force.back(), hand.force_limit, 1e-3 * hand.force_limit) << stiffness;
    EXPECT_NEAR(trial.time.back(), hand.duration, 1e-9);  // and then nobody pushes any longer
  }
}

// The same law in a scene: a needle that does not buckle, a fixed stop, and a grip; what gives way is both.
TEST(Person, pushes_the_needle_of_a_rigid_scene_up_to_the_limit) {
  Scene scene;
  scene.needle_model = NeedleModel::column;  // whose force has no inertia
  scene.tissue.rigid = true;
  scene.needle.length = 0.1;
  scene.needle.radius = 1e-3;
  scene.contact.contact_radius = 2e-3;
  scene.hand = pusher();
  scene.hand.stiffness = 1000.0;
  scene.hand.duration = 5.0;
  const auto checked = validated(scene);
  ASSERT_TRUE(checked) << checked.error().sentence;
  auto simulation = Simulation::build(*checked);
  ASSERT_TRUE(simulation) << simulation.error().sentence;
  Hand hand(scene.hand, scene.run.time_step);
  Trial trial{{0.0}, {0.0}, {0.0}};
  while (const auto travel = hand.next(simulation->frame().hand_force)) {
    const Frame& frame = simulation->step(*travel);
    trial.time.push_back(frame.time);
    trial.force.push_back(frame.hand_force);
    ASSERT_LE(frame.hand_force, scene.hand.force_limit);
  }
  const double rod = 200e9 * 3.14159265358979 * 1e-6 / 0.1;  // N/m, EA / L
  const double stiffness = 1.0 / (1.0 / rod + 1.0 / scene.hand.stiffness);
  for (double share : {0.5, 0.9, 0.99})
    EXPECT_NEAR(trial.first(3.0 * share), time_to(share, stiffness, scene.hand), 5.0 * ms) << share;
  EXPECT_GT(trial.force.back(), 0.99 * scene.hand.force_limit);
}

// Under twice the limit: one sixth of Hill's slope there, v0 / (5 F0).
TEST(Person, gives_way_slowly_when_pushed_harder_than_the_limit) {
  HandScene hand = pusher();
  hand.duration = 2.0;
  const auto pushed = [&, step = 0](double) mutable { return ++step > 1000 ? 2.0 * hand.force_limit : 0.0; };
  const Trial trial = tried(hand, pushed);
  const double back = (trial.at(trial.travel, 1.9) - trial.at(trial.travel, 1.1)) / 0.8;
  EXPECT_NEAR(back, -hand.speed / 30.0, 1e-9);
}

struct Pause {
  double from = 0.0, length = 0.0;  // s
};

// Where the hand does not move but for its tremor.
std::vector<Pause> pauses(const Trial& trial, const HandScene& hand) {
  std::vector<Pause> all;
  bool still = false;
  for (std::size_t i = 1; i < trial.time.size(); ++i) {
    const auto aim = [&](std::size_t k) {
      return trial.travel[k] - tremor(hand.tremor, hand.seed, trial.time[k]);
    };
    const bool now = std::abs(aim(i) - aim(i - 1)) < 1e-12;
    if (now && !still) all.push_back({trial.time[i - 1], 0.0});
    if (now) all.back().length = trial.time[i] - all.back().from;
    still = now;
  }
  return all;
}

TEST(Person, reacts_to_contact_and_to_puncture_and_stands_still_for_the_asked_time) {
  for (double tremor : {0.0, 50e-6})
    for (double hesitation : {0.3, 0.8}) {
      HandScene hand = pusher();
      hand.tremor = tremor;
      hand.hesitation = hesitation;
      hand.travel = 22e-3;
      const Trial trial = tried(hand, skin(200.0, 6e-3, 2.0, 0.4));
      const std::vector<Pause> found = pauses(trial, hand);
      ASSERT_EQ(found.size(), 2U) << tremor << " m of tremor";
      const double touch = trial.first(1e-6), puncture = trial.drop();
      constexpr double noticed_within = 0.1;  // s
      for (const auto& [pause, event] : {std::pair(found[0], touch), std::pair(found[1], puncture)}) {
        EXPECT_GT(pause.from, event + hand.reaction);
        EXPECT_LT(pause.from, event + hand.reaction + noticed_within);
        EXPECT_NEAR(pause.length, hesitation, 1.5 * ms);
      }
    }
}

TEST(Person, needle_that_gives_way_is_felt_too) {
  HandScene hand = pusher();
  hand.hesitation = 0.5;
  hand.travel = 30e-3;
  // As a column does: it carries no more from 8 mm on.
  const Trial trial = tried(hand, [](double travel) { return 150.0 * std::min(travel, 8e-3); });
  const std::vector<Pause> found = pauses(trial, hand);
  ASSERT_EQ(found.size(), 2U);
  EXPECT_LT(trial.at(trial.travel, found[0].from), 8e-3);  // contact
  EXPECT_GT(trial.at(trial.travel, found[1].from), 8e-3);  // buckling
  EXPECT_NEAR(found[1].length, 0.5, 1.5 * ms);
}

// Tissue that springs against the needle again behind the skin, and gives in while the hand stands: all that
// is one contact and one puncture.
TEST(Person, is_not_startled_by_what_it_does_itself) {
  HandScene hand = pusher();
  hand.hesitation = 0.4;
  hand.travel = 32e-3;
  for (double stiffness : {100.0, 200.0, 300.0}) {
    double sunk = 0.0, start = 6e-3;  // m
    bool broken = false;
    const Trial trial = tried(hand, [&](double travel) {
      double force = stiffness * std::max(travel - start - sunk, 0.0);
      if (!broken && force >= 1.6) broken = true, start = travel - sunk - 0.4 / stiffness, force = 0.4;
      constexpr double relaxation = 1.0;                                    // s
      sunk += ms / relaxation * std::min(0.2 * force / stiffness, 0.5e-3);  // a little, and slowly
      return force;
    });
    const std::vector<Pause> found = pauses(trial, hand);
    EXPECT_EQ(found.size(), 2U) << stiffness << " N/m";
  }
}

// Through a skin into nothing: the unloaded hand goes on at its full speed until it has reacted.
TEST(Person, overshoots_by_the_way_it_goes_until_it_can_react) {
  for (double reaction : {0.15, 0.2, 0.3}) {
    HandScene hand = pusher();
    hand.reaction = reaction;
    hand.hesitation = 1.0;
    hand.travel = 60e-3;
    const Trial trial = tried(hand, skin(300.0, 0.0, 2.0, 0.0));
    const std::vector<Pause> found = pauses(trial, hand);
    ASSERT_GE(found.size(), 2U);
    const double overshoot = trial.at(trial.travel, found[1].from) - trial.at(trial.travel, trial.drop());
    EXPECT_GT(overshoot, hand.speed * reaction);
    EXPECT_LT(overshoot, hand.speed * (reaction + 0.05));
  }
}

TEST(Person, is_the_same_twice_and_another_with_another_seed) {
  HandScene hand = pusher();
  hand.tremor = 50e-6;
  hand.hesitation = 0.4;
  const auto travel = [&] { return tried(hand, skin(200.0, 6e-3, 2.0, 0.4)).travel; };
  const std::vector<double> once = travel();
  EXPECT_EQ(travel(), once);
  hand.seed = 2;
  EXPECT_NE(travel(), once);
}

TEST(Person, converges_as_the_time_step_is_halved) {
  HandScene hand = pusher();
  hand.tremor = 50e-6;
  hand.hesitation = 0.4;
  const auto trial = [&](double step) { return tried(hand, skin(200.0, 6e-3, 2.0, 0.4), step); };
  const Trial exact = trial(ms / 32.0);
  const auto error = [&](double step) {
    const Trial coarse = trial(step);
    double worst = 0.0;
    for (double t = 0.0; t < 4.0; t += 0.05)
      worst = std::max(worst, std::abs(coarse.at(coarse.travel, t) - exact.at(exact.travel, t)));
    return worst;
  };
  // Of first order: off by what the hand goes in a step or two, and no event more or less.
  for (double step : {ms, ms / 2.0, ms / 4.0, ms / 8.0})
    EXPECT_LT(error(step), 2.0 * hand.speed * step) << step << " s";
}

TEST(Person, pulls_back_to_where_it_began_and_then_is_done) {
  HandScene hand = pusher();
  hand.hesitation = 0.4;
  hand.travel = 20e-3;
  hand.pulls_back = true;
  const Trial trial = tried(hand, [](double) { return 0.0; });
  EXPECT_NEAR(*std::max_element(trial.travel.begin(), trial.travel.end()), hand.travel, 1e-15);
  EXPECT_EQ(trial.travel.back(), 0.0);
  EXPECT_NEAR(trial.time.back(), 2.0 * hand.travel / hand.speed + hand.hesitation, 2.5 * ms);
}

TEST(Person, gives_up_a_needle_that_goes_neither_in_nor_out) {
  HandScene hand = pusher();
  hand.hesitation = 0.4;
  hand.duration = 3.0;
  hand.pulls_back = true;
  // It sticks where it has come to, 5 mm deep, and is held there by a spring.
  const Trial trial = tried(hand, [stuck = false](double travel) mutable {
    stuck = stuck || travel > 5e-3;
    return stuck ? 1000.0 * (travel - 5e-3) : 0.0;
  });
  EXPECT_NEAR(trial.time.back(), longest_trial(hand), 2.5 * ms);
  for (double force : trial.force) ASSERT_LE(std::abs(force), hand.force_limit + 1e-9);
}

}  // namespace
}  // namespace acus
