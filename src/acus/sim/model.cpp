#include "acus/sim/model.h"

#include <algorithm>
#include <numbers>
#include <numeric>

#include "acus/coupling/punch.h"
#include "acus/mesh/block.h"
#include "acus/mesh/order.h"
#include "acus/mesh/quality.h"
#include "acus/mesh/refine.h"
#include "acus/numeric/circular.h"
#include "acus/sim/hand.h"
#include "acus/sim/prediction.h"
#include "acus/sim/support.h"
#include "acus/tissue/rest_matrix.h"

namespace acus {
namespace {

// Renumbers so that held nodes come last and the rest keep their order; returns how many are free.
int free_nodes_first(mesh::TetMesh& mesh, const std::vector<bool>& held) {
  std::vector<int> order(mesh.nodes.size());
  std::iota(order.begin(), order.end(), 0);
  const auto first_held = std::stable_partition(order.begin(), order.end(), [&](int i) { return !held[i]; });
  std::vector<Vec3> nodes(mesh.nodes.size());
  std::vector<int> new_index(mesh.nodes.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    nodes[i] = mesh.nodes[order[i]];
    new_index[order[i]] = static_cast<int>(i);
  }
  mesh.nodes = std::move(nodes);
  for (mesh::Tet& t : mesh.tets)
    for (int& node : t) node = new_index[node];
  return static_cast<int>(first_held - order.begin());
}

// The nodes in the far part of the mesh along `direction`: the share `fraction` of its extent.
std::vector<bool> far_nodes(const mesh::TetMesh& mesh, const Vec3& direction, double fraction) {
  double nearest = direction.dot(mesh.nodes.front());
  double farthest = nearest;
  for (const Vec3& x : mesh.nodes) {
    nearest = std::min(nearest, direction.dot(x));
    farthest = std::max(farthest, direction.dot(x));
  }
  constexpr double rounding = 1e-9;  // of the extent: a flat bottom counts as one plane
  const double from = farthest - (fraction + rounding) * (farthest - nearest);
  std::vector<bool> far;
  for (const Vec3& x : mesh.nodes) far.push_back(direction.dot(x) >= from);
  return far;
}

Result<mesh::TetMesh> tissue_mesh(Model& m, const mesh::TetMesh* given) {
  const TissueScene& t = m.scene.tissue;
  if (!given) {
    m.path = {Vec3(0.0, 0.0, t.size.z()), Vec3(0.0, 0.0, -1.0), t.size.z()};
    return mesh::build_graded_block(t.size, t.tetrahedra);
  }
  const auto path = mesh::find_path(*given, t.target, t.direction);
  if (!path) return Error{path.error().sentence};
  m.path = *path;
  // Edges along the path as fine as the contact, growing away from it.
  constexpr double grading = 0.5;
  return mesh::refined_along_path(*given, m.path.entry, m.path.entry + m.path.length * m.path.direction,
                                  m.scene.contact.contact_radius, grading, t.tetrahedra);
}

void build_channel(Model& m) {
  const ContactScene& c = m.scene.contact;
  m.channel.friction = c.friction;
  const int cells = static_cast<int>(m.path.length / coupling::channel_cell) + 1;
  m.channel.attachment.resize(cells);
  m.channel.stiffness.assign(cells, coupling::sleeve_stiffness(m.tissue.shear.front()));
  m.channel.count = cells;
  for (int cell = 0; cell < cells; ++cell) {
    const double depth = std::min((cell + 0.5) * coupling::channel_cell, m.path.length);
    const Vec3 point = m.path.entry + depth * m.path.direction;
    attach_shaft_into(m.channel.attachment[cell], m, point);
  }
}

coupling::Guide guide_above_entry(const Model& m) {
  const GuideScene& scene = m.scene.guide;
  const Vec3 up = -m.path.direction;
  constexpr double per_edge = 2.0;  // of the rod, so that none slips through
  // Farther up there is never a needle: a hand may go back by as much as is in front of it.
  const double length = std::min(scene.length, 2.0 * m.needle.length);
  coupling::Guide guide =
      coupling::build_guide(m.path.entry + scene.gap * up, up, length, m.rod.edge_length.front() / per_edge);
  guide.stiffness = scene.stiffness;
  guide.friction = scene.friction;
  return guide;
}

// As at the entry, all the way: deeper, where the tissue surrounds the tip, about half as much is missing.
double tip_stiffness(const Model& m) {
  const ContactScene& c = m.scene.contact;
  if (!c.near_field || c.coupling == Coupling::nearest_node) return c.stiffness;
  const double missing = coupling::missing_share(m.mesh, *m.locator, m.path.entry, m.path.direction,
                                                 c.contact_radius, m.disc_rings);
  return 1.0 / (1.0 / c.stiffness + missing * half_space_sink(1.0, m.scene.tissue, c.contact_radius));
}

// A column's force is that of its contact spring, stiffness times a way, so it magnifies what the tissue is
// left to go by as much as the spring is stiffer than the tissue answers a step under the tip. By so many
// times the default's half percent stands. A rod is in balance with its springs as they are.
double tolerance_share(const Model& m) {
  if (m.bends_freely()) return 1.0;
  constexpr double most_magnified = 100.0;
  const double h = m.scene.run.time_step;
  const double compliance = half_space_sink(1.0, m.scene.tissue, m.scene.contact.contact_radius) * h * h /
                            m.factors.stiffness;  // m/N
  return std::min(1.0, most_magnified / (m.tip_stiffness * compliance));
}

void precondition(Model& m) {
  const numeric::LowerBlocks at_rest = tissue::rest_matrix(m.tissue, m.factors.mass, m.factors.stiffness);
  m.inverse_block = numeric::inverse_diagonal(at_rest);
  m.coarse = numeric::build_coarse_space(std::span(m.mesh.nodes).first(m.tissue.free_nodes), at_rest);
}

}  // namespace

void attach_disc_into(coupling::Attachment& out, const Model& m, const Vec3& point, const Vec3& axis) {
  const ContactScene& c = m.scene.contact;
  if (c.coupling == Coupling::nearest_node)
    coupling::attach_to_nearest_node_into(out, *m.locator, point, m.tissue.free_nodes);
  else
    coupling::embed_disc_into(out, *m.locator, point, axis, c.contact_radius, m.tissue.free_nodes,
                              m.disc_rings);
}

void attach_shaft_into(coupling::Attachment& out, const Model& m, const Vec3& point) {
  const ContactScene& c = m.scene.contact;
  if (c.coupling == Coupling::nearest_node)
    coupling::attach_to_nearest_node_into(out, *m.locator, point, m.tissue.free_nodes);
  else
    coupling::embed_point_into(out, *m.locator, point, c.contact_radius, m.tissue.free_nodes);
}

void attach_tip_into(coupling::Attachment& out, const Model& m, double depth) {
  attach_disc_into(out, m, m.path.entry + depth * m.path.direction, m.path.direction);
}

Result<Model> build_model(const Scene& scene, const mesh::TetMesh* mesh) {
  auto valid = validated(scene);
  if (!valid) return valid.error();
  Model m;
  m.scene = *valid;
  m.needle = in_front_of_hand(m.scene);
  m.column = needle::build_column(m.needle);
  constexpr int rod_edges = 60;  // 0.1 % of a critical load (needle/rod.h)
  m.rod = needle::build_rod(m.needle, rod_edges);
  m.grip_compliance = grip_compliance(scene.hand);
  // Without it tissue at rest is solved for ever: what nobody feels, and what is nothing to a thin needle.
  constexpr double unfelt = 1e-3, share_of_critical = 1e-3;  // N, -
  m.least_load = std::min(unfelt, share_of_critical * critical_load(m.scene));
  m.cutting_force =
      force::cutting_force(scene.contact.fracture_toughness, scene.contact.crack, scene.needle.radius);
  constexpr double degree = std::numbers::pi / 180.0;
  // The point of a bevel is at the wall; the less it is ahead of the face's other end, 2 r cot(bevel) on a
  // face of 2 r / sin(bevel), the more the face opens the tissue evenly.
  if (scene.needle.bevel_degrees > 0.0)
    m.point_aside =
        scene.contact.bevel_share * scene.needle.radius * numeric::cos(scene.needle.bevel_degrees * degree);
  m.tip_stiffness = scene.contact.stiffness;
  if (m.rigid()) {
    m.path = {Vec3::Zero(), Vec3(0.0, 0.0, -1.0), 0.0};
    m.guide = guide_above_entry(m);
    return m;
  }
  auto built = tissue_mesh(m, mesh);
  if (!built) return built.error();
  m.mesh = mesh::ordered_for_locality(*built);
  const double held_fraction = mesh ? scene.tissue.fixed_fraction : 0.0;
  const int free_nodes = free_nodes_first(m.mesh, far_nodes(m.mesh, m.path.direction, held_fraction));
  const TissueScene& t = scene.tissue;
  const std::vector<tissue::Material> materials(m.mesh.tets.size(), m.material());
  auto tissue = tissue::build_tissue_model(
      m.mesh, materials, t.element, free_nodes,
      tissue::relaxation_step({t.relaxation_share, t.relaxation_time}, scene.run.time_step));
  if (!tissue) return tissue.error();
  m.tissue = std::move(*tissue);
  m.damping = {t.damping_mass, t.damping_stiffness};
  m.factors = tissue::step_factors(scene.run.time_step, m.damping);
  precondition(m);
  m.locator.emplace(m.mesh);
  m.disc_rings = coupling::rings_for(scene.contact.contact_radius, mesh::quality(m.mesh).shortest_edge);
  m.tip_stiffness = tip_stiffness(m);
  m.tolerance_share = tolerance_share(m);
  attach_tip_into(m.entry, m, 0.0);
  if (m.entry.empty())
    return Error{"tissue: the entry lies in the part that is held fixed; choose another target"};
  build_channel(m);
  m.guide = guide_above_entry(m);
  return m;
}

}  // namespace acus
