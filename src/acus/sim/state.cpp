#include "acus/sim/state.h"

#include <algorithm>

#include "acus/sim/hand.h"

namespace acus {

NeedlePlace place_needle(const Model& m, const State& s) {
  NeedlePlace place;
  place.free_length = m.scene.needle.length;
  place.shortening = s.hub_travel - s.tip_position;
  if (!s.punctured) return place;
  const auto surface_shift = [&](const coupling::Attachment& at) {
    return coupling::displacement_along(at, s.position, m.mesh.nodes, m.path.direction);
  };
  place.surface = surface_shift(m.entry);
  // The contact spring's own squeeze is not needle inside tissue.
  const double tip = s.tip_position - std::max(s.tip_elongation, 0.0);
  place.inserted_length = std::max(tip - place.surface, 0.0);
  const double beyond_entry = s.through ? s.tip_position - place.surface : place.inserted_length;
  place.free_length -= std::max(beyond_entry, 0.0);
  place.covered_depth = std::clamp(s.channel_depth + s.tip_elongation, 0.0, s.channel_depth);
  return place;
}

State initial_state(const Model& m) {
  State s;
  // The hand may start before first touch; the tip is as far away then.
  s.hub_travel = s.tip_position = s.tip_elongation = start_travel(m.scene.hand);
  s.energy_force = force::EnergyForce(s.hub_travel);
  if (m.rigid()) return s;
  s.position = m.mesh.nodes;
  s.velocity.assign(static_cast<std::size_t>(m.tissue.free_nodes) * numeric::node_stride, 0.0);
  s.velocity_change = s.velocity;
  s.influence.assign(s.velocity.size(), 0.0F);
  s.tip = m.entry;
  s.tip.reserve(4 * coupling::points_of(m.disc_rings));
  s.channel.length.assign(m.channel.cells(), 0.0);
  s.channel.elongation.assign(m.channel.cells(), 0.0);
  return s;
}

}  // namespace acus
