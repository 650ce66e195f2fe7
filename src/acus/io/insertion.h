// One insertion from a scene to its end: what the command line and the studies both run.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "acus/base/result.h"
#include "acus/sim/scene.h"
#include "acus/sim/simulation.h"
#include "acus/sim/summary.h"

namespace acus::io {

// The simulation of a scene; reads tissue.mesh if the scene names one. Errors name the key or the mesh file.
Result<Simulation> build_simulation(const Scene& scene, int threads = 1);

// Number of steps that the hand's movement takes; of a person's, at most.
int step_count(const Scene& scene);

// Called with the state before the first step, and after every step; false ends the insertion there.
using Observer = std::function<bool(const Simulation&)>;

struct Insertion {
  Scene scene;
  Summary summary;
  Frame last;  // at the end
  std::vector<Event> events;
  std::uint64_t state_hash = 0;
  int nodes = 0, tetrahedra = 0;
  bool interrupted = false;  // by the observer
};

// Where the hand is [m] at the end of the next step, told what was seen of the last one; nothing after the
// last.
using NextTravel = std::function<std::optional<double>(const Frame& last)>;

// One travel after another; they must outlive it.
NextTravel following(std::span<const double> travels);

// Takes the steps with a simulation that was just built. One that goes wrong ends the insertion early: see
// summary.health.
Insertion run_insertion(Simulation& simulation, const NextTravel& next, const Observer& observer);

// The same along the movement of the scene's hand, to its end.
Insertion run_insertion(Simulation& simulation, const Observer& observer = {});

}  // namespace acus::io
