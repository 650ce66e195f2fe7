#include "acus/io/insertion.h"

#include "acus/sim/hand.h"

namespace acus::io {

int step_count(const Scene& scene) { return acus::step_count(scene.hand, scene.run.time_step); }

NextTravel following(std::span<const double> travels) {
  return [travels, step = std::size_t{0}](const Frame&) mutable {
    return step < travels.size() ? std::optional(travels[step++]) : std::nullopt;
  };
}

Insertion run_insertion(Simulation& simulation, const Observer& observer) {
  Hand hand(simulation.scene().hand, simulation.scene().run.time_step);
  const auto travel = [&](const Frame& last) { return hand.next(last.hand_force); };
  return run_insertion(simulation, travel, observer);
}

Insertion run_insertion(Simulation& simulation, const NextTravel& next, const Observer& observer) {
  Insertion insertion;
  insertion.scene = simulation.scene();
  insertion.nodes = static_cast<int>(simulation.tissue().nodes.size());
  insertion.tetrahedra = static_cast<int>(simulation.tissue().tets.size());
  insertion.interrupted = observer && !observer(simulation);
  while (!insertion.interrupted) {
    const std::optional<double> travel = next(simulation.frame());
    if (!travel) break;
    const Frame& frame = simulation.step(*travel);
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
