// Runs a scene in memory and keeps all that is seen of it.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "acus/force/energy_force.h"
#include "acus/needle/buckling.h"
#include "acus/sim/hand.h"
#include "acus/sim/simulation.h"

namespace acus::physics {

struct Insertion {
  Scene scene;
  std::vector<Frame> frames;
  std::vector<Event> events;
  std::uint64_t hash = 0;

  std::optional<Event> first(EventKind kind) const {
    const auto it =
        std::find_if(events.begin(), events.end(), [&](const Event& e) { return e.kind == kind; });
    return it == events.end() ? std::nullopt : std::optional<Event>(*it);
  }
  // The first frame at or after a travel of the hand. m
  const Frame& at_travel(double travel) const {
    for (const Frame& f : frames)
      if (f.hand_travel >= travel - 1e-12) return f;
    ADD_FAILURE() << "the hand never came to " << travel << " m";
    return frames.back();
  }
};

// Steps the scene through its hand's whole movement, or until `stop` says so or it comes to `end`; `threads`
// share each step.
inline Insertion insert(const Scene& scene, const std::function<bool(const Frame&)>& stop = {},
                        Health end = Health::good, int threads = 1) {
  auto simulation = Simulation::build(scene, nullptr, threads);
  if (!simulation) {
    ADD_FAILURE() << simulation.error().sentence;
    return {};
  }
  Insertion run;
  run.scene = scene;
  Hand hand(scene.hand, scene.run.time_step);
  while (const std::optional<double> travel = hand.next(simulation->frame().hand_force)) {
    const Frame& frame = simulation->step(*travel);
    if (end != Health::good && frame.health == end) break;
    run.frames.push_back(frame);
    if (frame.health != Health::good) {
      ADD_FAILURE() << "the step to " << frame.time << " s failed with health "
                    << static_cast<int>(frame.health);
      break;
    }
    if (stop && stop(frame)) break;
  }
  run.events.assign(simulation->events().begin(), simulation->events().end());
  run.hash = simulation->state_hash();
  return run;
}

// Table I's tissue, small enough for a test, pushed `travel` [m] at `speed` [m/s].
inline Scene table_one(double length, double travel, double speed = 30e-3, int tetrahedra = 1200) {
  Scene scene;
  scene.needle.length = length;
  scene.tissue.tetrahedra = tetrahedra;
  scene.hand.speed = speed;
  scene.hand.travel = travel;
  return scene;
}

// The same with the paper's column.
inline Scene column_in_table_one(double length, double travel, double speed = 30e-3, int tetrahedra = 1200) {
  Scene scene = table_one(length, travel, speed, tetrahedra);
  scene.needle_model = NeedleModel::column;
  return scene;
}

// Table I's needle pushed into a mesh of the default block that is given, and taken as it is. Nothing is cut;
// friction [N/m] alone carries the load, which then falls linearly along what is inside.
inline Scene uncut_in_given_block(double friction) {
  Scene scene;
  scene.needle_model = NeedleModel::rod;
  scene.needle.imperfection = 0.01e-3;
  scene.tissue.mesh = "given";
  scene.tissue.target = {1e-5, 1e-5, 0.03};
  scene.tissue.fixed_fraction = 0.001;
  scene.tissue.tetrahedra = 100;  // fewer than it has: no refinement
  scene.contact.rupture_force = 1e-3;
  scene.contact.fracture_toughness = 0.0;
  scene.contact.friction = friction;
  return scene;
}

inline double euler_load(const Scene& scene, double free_length) {
  return needle::critical_load(needle::bending_rigidity(scene.needle), free_length, scene.needle.support);
}

// Table I's needle: EI = 1.2723e-3 N m^2, so pi^2 EI / L^2 = 0.31394 N at 200 mm; factors of Euler's theory.
inline constexpr double pinned_pinned_load = 0.31394;  // N
inline constexpr std::pair<needle::Support, double> euler_factors[] = {
    {needle::Support::pinned_pinned, 1.0},
    {needle::Support::clamped_pinned, 2.04575},
    {needle::Support::clamped_clamped, 4.0},
    {needle::Support::clamped_free, 0.25}};

// N. Southwell's plot: bow against bow / load is a straight line whose slope is the critical load, whatever
// the imperfection. Read from the bows of the trace beyond the `initial` one, from `least` to `most` [m],
// without knowing the load beforehand.
inline double southwell_load(const Insertion& run, double initial, double least, double most) {
  std::vector<std::pair<double, double>> plot;  // bow / load, bow
  double mx = 0.0, my = 0.0, sxy = 0.0, sxx = 0.0;
  for (const Frame& f : run.frames)
    if (const double bow = f.deflection - initial; bow > least && bow < most) {
      plot.push_back({bow / f.hand_force, bow});
      mx += plot.back().first, my += bow;
    }
  EXPECT_GT(plot.size(), 5U);
  mx /= static_cast<double>(plot.size()), my /= static_cast<double>(plot.size());
  for (auto [x, y] : plot) sxy += (x - mx) * (y - my), sxx += (x - mx) * (x - mx);
  return sxy / sxx;
}

}  // namespace acus::physics
