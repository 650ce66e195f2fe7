#include "acus/sim/rod_contact.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "acus/coupling/near_field.h"
#include "acus/numeric/circular.h"
#include "acus/tissue/deformation.h"

namespace acus {
namespace {

using coupling::Grip;
using needle::RodPoint;

Vec3 tangent_at(const State& s, int edge) { return needle::edge(s.needle.rod, edge).normalized(); }
Vec3 across(const Vec3& v, const Vec3& axis) { return v - v.dot(axis) * axis; }

// Nearest point of the rod, sought downhill from an edge.
RodPoint nearest_point(const Model& m, const State& s, const Vec3& y, int start) {
  const needle::RodState& rod = s.needle.rod;
  int way = 0;
  for (int j = start;;) {
    const Vec3 e = needle::edge(rod, j);
    const double along = e.dot(y - rod.position[j]) / e.squaredNorm();
    const int next = along < 0.0 ? -1 : along > 1.0 ? 1 : 0;
    const bool ends = next == 0 || next * way < 0 || j + next < 0 || j + next >= m.rod.edges;
    if (ends) return {j, std::clamp(along, 0.0, 1.0)};
    way = next;
    j += next;
  }
}

double arc_from_hub(const Model& m, const RodPoint& p) {
  return (p.edge + p.along) * m.rod.edge_length.front();
}

Vec3 entry_now(const Model& m, const State& s) {
  if (m.rigid()) return m.path.entry;
  return m.path.entry + coupling::displacement(m.entry, s.position, m.mesh.nodes);
}

Vec3 channel_end_now(const Model& m, const State& s) {
  if (m.rigid()) return m.path.entry;
  return s.needle.channel_end + coupling::displacement(s.tip, s.position, m.mesh.nodes);
}

Vec3 cell_now(const Model& m, const State& s, int cell) {
  return s.needle.cell_point[cell] +
         coupling::displacement(s.needle.channel.attachment[cell], s.position, m.mesh.nodes);
}

// N/m, by which the tip is held across its axis: by the dent it makes on the surface, in its cut as the shaft
// is.
double tip_hold(const Model& m, const State& s) {
  if (s.through) return 0.0;
  const int cells = s.needle.channel.cells();
  if (s.punctured)  // drawn back, its cells hold it
    return cells > 0 && s.tip_elongation >= 0.0 ? s.needle.cell_lateral[cells - 1] * coupling::channel_cell
                                                : 0.0;
  const bool rests = s.tip_elongation > 0.0 && m.scene.needle.support != needle::Support::clamped_free;
  return rests ? m.tip_stiffness : 0.0;
}

// The surface is pressed along the path, whichever way the tip points; a cut goes where it points.
Vec3 tip_axis(const Model& m, const State& s) {
  return s.punctured ? tangent_at(s, m.rod.edges - 1) : m.path.direction;
}

void place_tip(const Model& m, State& s) {
  RodNeedle& n = s.needle;
  const Vec3 gap = n.rod.position.back() - channel_end_now(m, s);
  const Vec3 axis = tip_axis(m, s);
  if (s.tip_elongation <= 0.0) s.tip_elongation = std::min(gap.dot(axis), 0.0);
  // A spring that is pressed remembers; the cut follows. Across, it holds the tip where it came to rest.
  if (s.punctured) return;
  if (!n.tip_rests) n.tip_offset = across(gap, axis);
  n.tip_rests = s.tip_elongation > 0.0;
}

// m, from the middle of the tip to the point of its bevel, which is what cuts.
Vec3 point_from_tip(const Model& m, const State& s) {
  if (m.point_aside == 0.0) return Vec3::Zero();
  constexpr double degree = std::numbers::pi / 180.0;
  const double turn = m.scene.needle.bevel_turn_degrees * degree;
  const Vec3& director = s.needle.rod.director.back();
  const Vec3 axis = tangent_at(s, m.rod.edges - 1);
  return m.point_aside * (numeric::cos(turn) * director + numeric::sin(turn) * axis.cross(director));
}

RodContact tip_contact(const Model& m, State& s) {
  RodContact c;
  c.elongation = &s.tip_elongation;
  c.at = &s.tip;
  c.point = {m.rod.edges - 1, 1.0};
  c.axis = tip_axis(m, s);
  c.slider = tip_slider(m, s);
  if (s.needle.cut_begun) c.arm = point_from_tip(m, s);
  c.lateral = tip_hold(m, s);
  c.lateral_elongation =
      across(s.needle.rod.position.back() + c.arm - channel_end_now(m, s) - s.needle.tip_offset, c.axis);
  return c;
}

RodContact cell_contact(const Model& m, State& s, int cell, int start_edge) {
  const Vec3 y = cell_now(m, s, cell);
  RodContact c;
  c.at = &s.needle.channel.attachment[cell];
  c.point = nearest_point(m, s, y, start_edge);
  c.axis = tangent_at(s, c.point.edge);
  c.slider = coupling::slider_of(s.needle.channel, s.channel, cell);
  c.lateral = s.needle.cell_lateral[cell] * s.channel.length[cell];
  c.lateral_elongation = across(needle::place_of(s.needle.rod, c.point) - y, c.axis);
  c.elongation = &s.channel.elongation[cell];
  return c;
}

// Between hand and tip; a hand that has come down so far has pushed the guide together.
bool is_in_guide(const Model& m, const State& s, int point) {
  const auto depth = [&](const Vec3& x) { return m.path.direction.dot(x - m.guide.point[point]); };
  return depth(s.needle.rod.position.front()) <= 0.0 && depth(s.needle.rod.position.back()) >= 0.0;
}

// Where the rod passes a point of the guide: the first place from `start` towards the hub that is level with
// it. A bow that hangs down beside the guide comes later and is not taken for it.
RodPoint point_in_guide(const Model& m, const State& s, int point, int start) {
  const needle::RodState& rod = s.needle.rod;
  const auto depth = [&](int node) {
    return m.path.direction.dot(rod.position[node] - m.guide.point[point]);
  };
  int j = start;
  while (j > 0 && depth(j) > 0.0) --j;
  while (j + 1 < m.rod.edges && depth(j + 1) < 0.0) ++j;
  const double before = depth(j), behind = depth(j + 1);
  return {j, behind > before ? std::clamp(-before / (behind - before), 0.0, 1.0) : 0.0};
}

RodContact guide_contact(const Model& m, State& s, int point, int start_edge) {
  GuideHold& hold = s.guide[point];
  RodContact c;
  c.at = &m.guide.nowhere;
  c.point = point_in_guide(m, s, point, start_edge);
  c.axis = m.path.direction;
  const Vec3 aside = across(needle::place_of(s.needle.rod, c.point) - m.guide.point[point], c.axis);
  if (!hold.holds) hold = {true, 0.0, aside};
  constexpr double closing = 5e-3;  // m, of sliding
  const double slid = m.scene.run.time_step * std::abs(c.axis.dot(at_contact(s.needle.rod.rate, c)));
  hold.offset *= std::max(0.0, 1.0 - slid / closing);
  c.slider = coupling::slider_of(m.guide, point, hold.elongation);
  c.lateral = m.guide.stiffness * m.guide.length[point];
  c.lateral_elongation = aside - hold.offset;
  c.elongation = &hold.elongation;
  return c;
}

// The points of the guide that the needle has left let go of it. Returns what they held along it, J: it is
// friction's.
double leave_guide(const Model& m, State& s) {
  double released = 0.0;
  for (int point = 0; point < m.guide.points(); ++point) {
    if (is_in_guide(m, s, point)) continue;
    const double elongation = s.guide[point].elongation;
    released += coupling::stored_energy(coupling::slider_of(m.guide, point, elongation), elongation);
    s.guide[point] = {};
  }
  return released;
}

void take_branch(RodContact& c) {
  const coupling::LinearForce f = coupling::force_on(c.slider, c.grip);
  const Mat3 along = c.axis * c.axis.transpose();
  c.stiffness = f.rate * along + c.lateral * (Mat3::Identity() - along);
  c.force = -f.constant * c.axis - c.lateral * c.lateral_elongation;
}

double stored(const RodContact& c, double along, const Vec3& sideways) {
  return coupling::stored_energy(c.slider, along) + 0.5 * c.lateral * sideways.squaredNorm();
}

// m, across the shaft: side of the square box of which a tetrahedron is a sixth, as long as it reaches along
// the shaft.
double spacing_across(const Model& m, int tet, const Vec3& axis) {
  double least = 1e300, most = -1e300;
  for (const int node : m.mesh.tets[tet]) {
    const double along = axis.dot(m.mesh.nodes[node]);
    least = std::min(least, along);
    most = std::max(most, along);
  }
  return std::sqrt(6.0 * m.tissue.volume[m.tissue.element[tet]] / (most - least));
}

// The next cell of the channel, half a cell ahead of where it begins.
void add_cell(const Model& m, State& s, const Vec3& direction) {
  RodNeedle& n = s.needle;
  const int cell = n.channel.cells();
  if (cell >= m.most_cells()) return;
  const double ahead = (cell + 0.5) * coupling::channel_cell - s.channel_depth;
  const Vec3 point = n.channel_end + ahead * direction;
  attach_shaft_into(n.channel.attachment[cell], m, point);
  n.cell_point[cell] = point;
  const auto held = m.locator->locate(point, m.scene.contact.contact_radius);
  coupling::NearField near;  // outside of the mesh nothing holds
  if (held) {
    const double spacing = m.scene.contact.near_field ? spacing_across(m, held->tet, direction) : 0.0;
    near = coupling::near_field(tissue::shear_modulus(m.material()), m.scene.tissue.poisson_ratio, spacing,
                                m.scene.needle.radius);
  }
  n.cell_lateral[cell] = near.lateral;
  n.channel.stiffness[cell] = near.axial;
  ++n.channel.count;
}

// Where a short way through deformed tissue leads at rest. Tissue that is crumpled under the tip, so that it
// would lead aside or back, says nothing.
Vec3 way_at_rest(const Mat3& F, const Vec3& way) {
  if (F.determinant() < 0.01) return way;
  const Vec3 at_rest = F.inverse() * way;
  constexpr double crumpled = 0.5;  // cosine of the turn
  return at_rest.dot(way) > crumpled * at_rest.norm() * way.norm() ? at_rest : way;
}

}  // namespace

RodPlace place_rod(const Model& m, const State& s) {
  const needle::RodState& rod = s.needle.rod;
  RodPlace place;
  place.free_length = m.needle.length;
  const Vec3 from = rod.position.front(), to = entry_now(m, s);
  int last = m.rod.edges;
  if (s.punctured) {
    const RodPoint entry = nearest_point(m, s, to, m.rod.edges - 1);
    const double beyond = m.needle.length - arc_from_hub(m, entry);
    place.inserted_length = s.through ? std::clamp(beyond, 0.0, s.channel_depth)
                                      : std::max(beyond - std::max(s.tip_elongation, 0.0), 0.0);
    place.free_length -= std::max(beyond, 0.0);
    place.covered_depth = std::clamp(s.channel_depth + s.tip_elongation, 0.0, s.channel_depth);
    last = entry.edge;
  }
  const int inside = std::min(last + 1, m.rod.edges + 1);
  const auto bow_of = [&](int first, int end, const Vec3& a, const Vec3& b) {
    const Vec3 axis = (b - a).normalized();
    double most = 0.0;
    for (int i = first; i < end; ++i) most = std::max(most, across(rod.position[i] - a, axis).norm());
    return most;
  };
  place.bow = bow_of(1, inside, from, to);
  place.span = place.free_length;
  place.bow_ratio = place.bow / place.span;
  if (m.guide.points() == 0) return place;
  // Above and below the guide, between their own ends.
  const auto is_above = [&](int node, const Vec3& x) {
    return m.path.direction.dot(rod.position[node] - x) < 0.0;
  };
  int top = 0, bottom = inside - 1;
  while (top < bottom && is_above(top, m.guide.point.back())) ++top;
  while (bottom > top && !is_above(bottom, m.guide.point.front())) --bottom;
  place.bow_ratio = 0.0;
  for (const auto& [first, end] : {std::pair{0, top}, std::pair{bottom, inside - 1}}) {
    const double span = (end - first) * m.rod.edge_length.front();
    if (end - first < 2) continue;
    const double ratio = bow_of(first + 1, end, rod.position[first], rod.position[end]) / span;
    if (ratio > place.bow_ratio) place.bow_ratio = ratio, place.span = span;
  }
  return place;
}

void touch_rod(const Model& m, State& s, Scratch& w) {
  place_tip(m, s);
  const RodPlace place = place_rod(m, s);
  const double released =
      coupling::cover(s.channel, s.needle.channel, place.covered_depth, place.inserted_length) +
      leave_guide(m, s);
  s.ledger.work_friction += released;
  w.rod.contacts.clear();
  w.rod.contacts.push_back(tip_contact(m, s));
  int edge = m.rod.edges - 1;
  for (int cell = s.needle.channel.cells() - 1; cell >= 0; --cell) {
    if (s.channel.length[cell] == 0.0) continue;
    w.rod.contacts.push_back(cell_contact(m, s, cell, edge));
    edge = w.rod.contacts.back().point.edge;
  }
  for (int point = 0; point < m.guide.points(); ++point) {
    if (!is_in_guide(m, s, point)) continue;
    w.rod.contacts.push_back(guide_contact(m, s, point, edge));
    edge = w.rod.contacts.back().point.edge;
  }
  double energy = 0.0;
  for (const RodContact& c : w.rod.contacts) energy += stored(c, c.slider.elongation, c.lateral_elongation);
  s.ledger.work_numerical += s.ledger.energy_contact - energy - released;
  s.ledger.energy_contact = energy;
  correct_grips(m, s, w);
  for (RodContact& c : w.rod.contacts) take_branch(c);
}

Vec3 at_contact(const std::vector<double>& unknowns, const RodContact& c) {
  const auto at = [&](int node) { return Vec3::Map(&unknowns[needle::place_at(node)]); };
  return (1.0 - c.point.along) * at(c.point.edge) + c.point.along * at(c.point.edge + 1);
}

Vec3 tissue_rate(const State& s, const RodContact& c) { return coupling::mean(*c.at, s.velocity); }

double turning_moment(const RodContact& c) { return c.axis.dot(c.arm.cross(c.force)); }

Vec3 contact_load(const RodContact& c, const Vec3& way) {
  return coupling::advance(c.slider, way.dot(c.axis)).force * c.axis +
         c.lateral * (c.lateral_elongation + across(way, c.axis));
}

bool correct_grips(const Model& m, const State& s, Scratch& w) {
  bool changed = false;
  for (RodContact& c : w.rod.contacts) {
    const double way =
        m.scene.run.time_step * c.axis.dot(at_contact(s.needle.rod.rate, c) - tissue_rate(s, c));
    const Grip grip = coupling::grip_after(c.slider, way);
    if (grip == c.grip) continue;
    changed = true;
    c.grip = grip;
    take_branch(c);
  }
  return changed;
}

coupling::NeedleSlide slide_rod(const Model& m, State& s, const Scratch& w) {
  coupling::NeedleSlide all;
  double energy = 0.0;
  for (const RodContact& c : w.rod.contacts) {
    const Vec3 way = m.scene.run.time_step * (at_contact(s.needle.rod.rate, c) - tissue_rate(s, c));
    const coupling::SliderStep step = coupling::advance(c.slider, way.dot(c.axis));
    const Vec3 sideways = across(way, c.axis);
    s.ledger.work_numerical += step.numerical + 0.5 * c.lateral * sideways.squaredNorm();
    s.ledger.work_damping += step.released;
    energy += stored(c, step.elongation, c.lateral_elongation + sideways);
    *c.elongation = step.elongation;
    if (&c == &w.rod.contacts.front()) {
      s.ledger.work_cutting += step.dissipated;
      // The spring has given this off as the arm turned, when the rod was laid over it again.
      s.ledger.work_numerical -=
          m.scene.run.time_step * turning_moment(c) * s.needle.rod.rate[needle::spin_at(c.point.edge)];
      all.tip = step;
    } else {
      s.ledger.work_friction += step.dissipated;
      if (c.at != &m.guide.nowhere) all.shaft_force += step.force * c.axis.dot(m.path.direction);
    }
  }
  s.ledger.energy_contact = energy;
  return all;
}

bool cut_along_tip(const Model& m, State& s, const coupling::SliderStep& tip) {
  const double slip = tip.slip;
  if (slip <= 0.0 || s.through || m.rigid()) return false;
  RodNeedle& n = s.needle;
  const Vec3 point = point_from_tip(m, s);
  if (!n.cut_begun) {  // under the point, wherever it touched
    n.channel_end += n.tip_offset + point;
    n.tip_offset.setZero();
    n.cut_begun = true;
  }
  const auto held = m.locator->locate(n.channel_end, m.scene.contact.contact_radius);
  const Vec3 axis = tangent_at(s, m.rod.edges - 1);
  const Mat3 F =
      held ? tissue::deformation_gradient(m.tissue, s.position, held->tet) : Mat3(Mat3::Identity());
  const Vec3 from = channel_end_now(m, s);
  const Vec3 to_point = n.rod.position.back() + point - from;
  // A tip without a side parts the tissue ahead of it. What the point of a bevel cuts ends where the point
  // is: ahead by the slip, and aside, but at no steep angle to the needle.
  constexpr double steepest = 0.2;
  const Vec3 aside = m.point_aside > 0.0 ? across(to_point, axis) : Vec3(Vec3::Zero());
  const Vec3 ahead = axis + aside / std::max(slip, aside.norm() / steepest);
  const Vec3 way = way_at_rest(F, ahead);
  const Vec3 direction = way.normalized();
  // Where the spring's end must be: what an earlier step left behind is made up for.
  const double wanted = axis.dot(to_point) - s.tip_elongation;
  const double first_try = slip * std::clamp(way.norm(), 0.2, 5.0);
  // The disc that spreads the tip load turns into the new direction over its own radius. What tissue is
  // deformed by differs from element to element; if the disc took each element's direction at once, its rim
  // would leap, and the tissue with it.
  const double turned = std::min(first_try / m.scene.contact.contact_radius, 1.0);
  n.disc_axis = (n.disc_axis + turned * (direction - n.disc_axis)).normalized();
  const Vec3 begin = n.channel_end;
  n.channel_end = begin + first_try * direction;
  attach_disc_into(s.tip, m, n.channel_end, n.disc_axis);
  // What the disc's mean makes of it: stretch of the tissue under the tip. Bounded, as is the advance, so
  // that a crumpled element cannot throw the cut far ahead in one step; the next step makes up for what is
  // missing.
  const double reached = axis.dot(channel_end_now(m, s) - from);
  const double stretch = std::clamp(reached / first_try, 0.2, 5.0);
  const double advance = std::clamp(first_try + (wanted - reached) / stretch, 0.0, 5.0 * slip);
  n.channel_end = begin + advance * direction;
  attach_disc_into(s.tip, m, n.channel_end, n.disc_axis);
  s.channel_depth += advance;
  // The shaft will come to lie in it with this energy, out of what the tip has spent.
  const double spread = std::min(spreading_force(m, s) * advance, tip.dissipated);
  s.ledger.work_cutting -= spread;
  s.ledger.work_numerical += spread;
  while (n.channel.cells() * coupling::channel_cell < s.channel_depth && n.channel.cells() < m.most_cells())
    add_cell(m, s, direction);
  const double beyond = (n.channel_end - m.path.entry).dot(m.path.direction) - m.path.length;
  if (beyond >= 0.0 || !m.locator->locate(n.channel_end, m.scene.contact.contact_radius)) {
    s.through = true;
    s.tip_elongation = 0.0;  // the contact spring lets go
  }
  return s.through;
}

}  // namespace acus
