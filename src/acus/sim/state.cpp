#include "acus/sim/state.h"

#include <algorithm>
#include <limits>

#include "acus/sim/hand.h"

namespace acus {

needle::Pose hub_pose(const Model& m, double travel) {
  const Vec3& along = m.path.direction;
  // The bow lies in one plane through the axis; for a needle along z it is the x-z plane.
  const Vec3 y = along.cross(Vec3::UnitY());
  const Vec3 sideways = y.norm() > 0.5 ? Vec3(y.normalized()) : Vec3(Vec3::UnitX());
  const Vec3 director = (sideways - sideways.dot(along) * along).normalized();
  return {m.path.entry + (travel - m.needle.length) * along, along, director};
}

double spreading_force(const Model& m, const State& s) {
  const int cells = s.needle.channel.cells();
  return cells > 0 ? 0.5 * s.needle.cell_lateral[cells - 1] * m.point_aside * m.point_aside : 0.0;
}

coupling::Slider tip_slider(const Model& m, const State& s) {
  const double unbreakable = std::numeric_limits<double>::infinity();
  if (m.rigid()) return {m.tip_stiffness, s.tip_elongation, 0.0, unbreakable, true};
  const double stiffness = s.through ? 0.0 : m.tip_stiffness;
  const double cutting = std::max(m.cutting_force, spreading_force(m, s));
  const double limit = s.through ? 0.0 : s.punctured ? cutting : m.scene.contact.rupture_force;
  return {stiffness, s.tip_elongation, 0.0, limit, true};
}

NeedlePlace place_needle(const Model& m, const State& s) {
  NeedlePlace place;
  place.free_length = m.needle.length;
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
  s.needle.hub = hub_pose(m, s.hub_travel);
  if (m.bends_freely()) s.needle.rod = needle::unloaded_rod(m.rod, s.needle.hub);
  s.needle.channel_end = m.path.entry;
  s.needle.disc_axis = m.path.direction;
  s.guide.resize(m.guide.points());
  if (m.rigid()) return s;
  s.position = m.mesh.nodes;
  s.velocity.assign(static_cast<std::size_t>(m.tissue.free_nodes) * numeric::node_stride, 0.0);
  s.velocity_change = s.velocity_bend = s.velocity;
  s.branch = tissue::build_branch(m.tissue);
  s.influence.assign(s.velocity.size(), 0.0F);
  s.tip = m.entry;
  s.tip.reserve(4 * coupling::points_of(m.disc_rings));
  const int cells = m.bends_freely() ? m.most_cells() : m.channel.cells();
  s.channel.length.assign(cells, 0.0);
  s.channel.elongation.assign(cells, 0.0);
  if (!m.bends_freely()) return s;
  RodNeedle& n = s.needle;
  n.channel = m.channel;
  n.channel.count = 0;
  n.channel.attachment.resize(cells);
  n.channel.stiffness.resize(cells);
  for (coupling::Attachment& at : n.channel.attachment) at.reserve(4);
  n.cell_point.resize(cells);
  n.cell_lateral.resize(cells);
  return s;
}

}  // namespace acus
