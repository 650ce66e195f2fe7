#include "acus/io/insertion.h"

#include <cmath>

#include "acus/sim/hand.h"

namespace acus::io {

int step_count(const Scene& scene) {
  constexpr double rounding = 1e-9;  // of a step: a duration of 8.0 s is 8000 steps of 1 ms, not 8001
  return static_cast<int>(std::ceil(duration(scene.hand) / scene.run.time_step - rounding));
}

Insertion run_insertion(Simulation& simulation, const Observer& observer) {
  const Scene& scene = simulation.scene();
  const auto travel = [&](int step) { return hand_travel(scene.hand, step * scene.run.time_step); };
  return run_insertion(simulation, step_count(scene), travel, observer);
}

Insertion run_insertion(Simulation& simulation, int steps, const TravelOf& travel, const Observer& observer) {
  Insertion insertion;
  insertion.scene = simulation.scene();
  insertion.nodes = static_cast<int>(simulation.tissue().nodes.size());
  insertion.tetrahedra = static_cast<int>(simulation.tissue().tets.size());
  insertion.interrupted = observer && !observer(simulation);
  for (int step = 1; step <= steps && !insertion.interrupted; ++step) {
    const Frame& frame = simulation.step(travel(step));
    add(insertion.summary, frame, simulation.events());
    insertion.interrupted = observer && !observer(simulation);
    if (frame.health != Health::good) break;
  }
  insertion.last = simulation.frame();
  insertion.events.assign(simulation.events().begin(), simulation.events().end());
  insertion.state_hash = simulation.state_hash();
  return insertion;
}

}  // namespace acus::io
