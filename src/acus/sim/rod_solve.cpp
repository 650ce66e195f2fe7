#include "acus/sim/rod_solve.h"

#include <algorithm>
#include <cmath>

#include "acus/numeric/root.h"
#include "acus/sim/rod_contact.h"
#include "acus/sim/tissue_step.h"

namespace acus {
namespace {

using numeric::NodeVector;

constexpr int max_passes = 80;  // of Newton's method and the branches together; two are usual
constexpr int easy_passes = 8;  // more are for a rod that is giving way
constexpr double slight_force = 1e-2, stride = 8.0;  // N; how much farther it goes while no more is left
// While the rod is far from balance, by so many times the tolerance, the tissue need not be solved for it to
// the last: a pass may leave this share of what it starts with (Dembo, Eisenstat and Steihaug 1982).
constexpr double far = 100.0, forcing = 0.2;
constexpr double force_error = 1e-6;  // N, and N per edge for moments: what may be left unbalanced

void add_at(std::vector<double>& to, int at, const Vec3& v) {
  for (int k = 0; k < 3; ++k) to[at + k] += v[k];
}
Vec3 three(const std::vector<double>& from, int at) { return Vec3::Map(&from[at]); }

// to += J^T v for one contact; J x is at_contact.
void add_to_rod(std::vector<double>& to, const RodContact& c, const Vec3& v) {
  add_at(to, needle::place_at(c.point.edge), (1.0 - c.point.along) * v);
  add_at(to, needle::place_at(c.point.edge + 1), c.point.along * v);
}
void add_block(needle::RodMatrix& matrix, int row, int column, const Mat3& block) {
  for (int r = 0; r < 3; ++r)
    for (int k = 0; k < 3; ++k)
      if (row + r >= column + k) matrix.add(row + r, column + k, block(r, k));
}

// What may clamp a tip.
needle::Pose stop_of(const Model& m, const needle::Pose& hub) {
  return {m.path.entry, m.path.direction, hub.director};
}

// N, of a grip on node 0, along the path.
double grip_pull(const Model& m, const State& s, const needle::Pose& hub) {
  return m.path.direction.dot(hub.position - s.needle.rod.position[0]) / m.grip_compliance;
}

// To the right-hand side, what contacts do while the tissue rests, and a grip.
void add_outside_to(std::vector<double>& residual, const Model& m, const State& s, const Scratch& w,
                    const needle::Pose& hub) {
  const double h = m.scene.run.time_step;
  for (const RodContact& c : w.rod.contacts)
    add_to_rod(residual, c, h * (c.force - h * c.stiffness * at_contact(s.needle.rod.rate, c)));
  const RodContact& tip = w.rod.contacts.front();
  residual[needle::spin_at(tip.point.edge)] += h * turning_moment(tip);
  if (m.grip_compliance > 0.0) add_at(residual, 0, h * grip_pull(m, s, hub) * m.path.direction);
}

// h^2 J^T K C v: what moving tissue does to the rod.
void add_tissue_to(std::vector<double>& load, const Model& m, const State& s, const Scratch& w) {
  const double h = m.scene.run.time_step;
  if (m.rigid()) return;
  for (const RodContact& c : w.rod.contacts) add_to_rod(load, c, h * h * c.stiffness * tissue_rate(s, c));
}

// What is out of balance at the iterate, the tissue's motion included. N s and N m s
void unbalance_into(std::vector<double>& load, const Model& m, const State& s, Scratch& w,
                    const needle::Pose& hub) {
  needle::RodMotion& motion = w.rod.motion;
  needle::load(motion, m.rod, s.needle.rod, hub, stop_of(m, hub), m.scene.run.time_step);
  add_outside_to(motion.residual, m, s, w, hub);
  load = motion.residual;
  add_tissue_to(load, m, s, w);
}

// Newton's matrix of the rod at the iterate while nobody holds the hub, and its right-hand side without
// anything from outside.
void linearise(const Model& m, const State& s, Scratch& w, const needle::Pose& hub, double compression) {
  const double h = m.scene.run.time_step;
  needle::RodMotion& motion = w.rod.motion;
  needle::linearise(motion, m.rod, s.needle.rod, hub, stop_of(m, hub), h, compression);
  for (const RodContact& c : w.rod.contacts) {
    const int a = needle::place_at(c.point.edge), b = needle::place_at(c.point.edge + 1);
    const double wa = 1.0 - c.point.along, wb = c.point.along;
    add_block(motion.matrix, a, a, h * h * wa * wa * c.stiffness);
    add_block(motion.matrix, b, a, h * h * wb * wa * c.stiffness);
    add_block(motion.matrix, b, b, h * h * wb * wb * c.stiffness);
  }
}

// The hand on node 0: it leads it, or holds it by a grip that gives way along the path alone.
void hold_hub(const Model& m, Scratch& w) {
  needle::RodMotion& motion = w.rod.motion;
  if (m.grip_compliance == 0.0) return needle::hold_hub(motion);
  const double h = m.scene.run.time_step;
  // kg, across: so heavy that nothing moves it, and not so heavy that its rounding holds node 0 along an
  // oblique path.
  constexpr double heavy = 1e10;
  const Mat3 axial = m.path.direction * m.path.direction.transpose();
  add_block(motion.matrix, 0, 0, h * h / m.grip_compliance * axial + heavy * (Mat3::Identity() - axial));
}

// Both, factored. What edges under compression take from the matrix is let go by and by where it is not
// definite.
bool factor_rod(const Model& m, const State& s, Scratch& w, const needle::Pose& hub) {
  for (double compression = 1.0;; compression = compression > 0.1 ? 0.5 * compression : 0.0) {
    linearise(m, s, w, hub, compression);
    hold_hub(m, w);
    if (w.rod.motion.matrix.factor()) break;
    if (compression == 0.0) return false;
  }
  add_outside_to(w.rod.motion.residual, m, s, w, hub);
  return true;
}

// What the hub holds is no imbalance: all of node 0, or what is across the path.
void leave_to_hub(const Model& m, std::vector<double>& load) {
  const Vec3& along = m.path.direction;
  const Vec3 free = m.grip_compliance > 0.0 ? Vec3(along.dot(three(load, 0)) * along) : Vec3(Vec3::Zero());
  for (int k = 0; k < 3; ++k) load[k] = free[k];
}

// N, the largest force or moment per edge of the rod that is out of balance.
double imbalance(const Model& m, const std::vector<double>& load) {
  const double arm = m.rod.edge_length.front();
  double largest = 0.0;
  for (int i = 0; i < m.rod.unknowns(); ++i)
    if (const double size = std::abs(load[i]) / (needle::is_spin(i) ? arm : 1.0); !(size <= largest))
      largest = size;  // also what is no number
  return largest / m.scene.run.time_step;
}

// y = A x with the rod's answer.
struct Product {
  const Model& m;
  Scratch& w;
  template <class Real>
  void operator()(numeric::NodeVectorOf<Real>& y, const numeric::NodeVectorOf<Real>& x) const {
    multiply_tissue(y, m, w, x);
    add_rod(y, x, 1.0);
  }
  template <class Real>
  void add_rod(numeric::NodeVectorOf<Real>& y, const numeric::NodeVectorOf<Real>& x, double times) const {
    const double h = m.scene.run.time_step;
    std::vector<double>& z = w.rod.load;
    std::fill(z.begin(), z.end(), 0.0);
    for (const RodContact& c : w.rod.contacts) {
      const Vec3 pull = h * h * c.stiffness * coupling::mean(*c.at, x);
      coupling::add_spread(y, *c.at, times * pull);
      add_to_rod(z, c, pull);
    }
    w.rod.motion.matrix.solve(z.data());
    for (const RodContact& c : w.rod.contacts)
      coupling::add_spread(y, *c.at, -times * h * h * c.stiffness * at_contact(z, c));
  }
};

// load += times h C^T (h K J (w + free answer) - f)
void add_contacts(NodeVector& load, const Model& m, const State& s, const Scratch& w, double times) {
  const double h = m.scene.run.time_step;
  for (const RodContact& c : w.rod.contacts) {
    const Vec3 rate = at_contact(s.needle.rod.rate, c) + at_contact(w.rod.free_answer, c);
    coupling::add_spread(load, *c.at, times * h * (h * c.stiffness * rate - c.force));
  }
}

// The rod as it was before the last change of its rates, and `share` of that change.
void go_part_of_the_way(const Model& m, State& s, Scratch& w, double share) {
  s.needle.rod = w.rod.before;
  for (int i = 0; i < m.rod.unknowns(); ++i) w.rod.motion.change[i] = share * w.rod.change[i];
  needle::apply_change(w.rod.motion, m.rod, s.needle.rod, m.scene.run.time_step);
}

// How far to go from (velocity_tried, rod.before) towards the solution for the branches as they were: the
// root in (0, 1] of the slope of the incremental potential on the way there, which holds the true sliders and
// the rod's true energy; 1 when it is still falling there. Leaves the rod somewhere on the way.
double line_search(const Model& m, State& s, Scratch& w, const needle::Pose& hub) {
  const double h = m.scene.run.time_step;
  needle::RodMotion& motion = w.rod.motion;
  for (RodContact& c : w.rod.contacts) {
    c.rate_before = at_contact(w.rod.before.rate, c);
    c.rate_change = at_contact(w.rod.change, c);
    if (m.rigid()) continue;
    c.rate_before -= coupling::mean(*c.at, w.velocity_tried);
    c.rate_change -= tissue_rate(s, c) - coupling::mean(*c.at, w.velocity_tried);
  }
  double tissue_slope = 0.0, tissue_curvature = 0.0;
  if (!m.rigid()) {
    NodeVector& change = w.change;
    numeric::copy_into(change, s.velocity, w.team);
    numeric::add_scaled_into(change, -1.0, w.velocity_tried, w.team);
    tissue_slope = -numeric::dot(change, w.imbalance_tried, w.team);
    tissue_curvature = -tissue_slope - numeric::dot(change, w.imbalance, w.team);
  }
  const auto slope = [&](double share) {
    go_part_of_the_way(m, s, w, share);
    needle::rod_forces_into(motion.force, m.rod, s.needle.rod, hub, stop_of(m, hub));
    double sum = tissue_slope + share * tissue_curvature;
    for (int i = 0; i < m.rod.unknowns(); ++i)
      sum += w.rod.change[i] * (needle::inertia(m.rod, i) * (s.needle.rod.rate[i] - motion.rate_before[i]) -
                                h * motion.force[i]);
    if (m.grip_compliance > 0.0)
      sum -= h * grip_pull(m, s, hub) * m.path.direction.dot(three(w.rod.change, 0));
    for (const RodContact& c : w.rod.contacts)
      sum += h * c.rate_change.dot(contact_load(c, h * (c.rate_before + share * c.rate_change)));
    return sum;
  };
  if (slope(1.0) <= 0.0 || slope(0.0) >= 0.0) return 1.0;
  constexpr double resolution = 1e-4;
  return numeric::bracketed_root(slope, 0.0, 1.0, resolution);
}

// One step of Newton's method for rod and tissue on the present branches. False when the solve fails.
bool improve(const Model& m, State& s, Scratch& w, RodOutcome& outcome, const StepProbe& probe) {
  needle::RodMotion& motion = w.rod.motion;
  if (!m.rigid()) {
    w.rod.free_answer = motion.residual;
    motion.matrix.solve(w.rod.free_answer.data());
    probe(StepPart::rod);
    double load = 0.0;
    for (const RodContact& c : w.rod.contacts)
      load += contact_load(c, m.scene.run.time_step * (at_contact(s.needle.rod.rate, c) - tissue_rate(s, c)))
                  .norm();
    const Product product{m, w};
    add_contacts(w.imbalance, m, s, w, 1.0);
    product.add_rod(w.imbalance, s.velocity, -1.0);
    numeric::copy_into(w.change, w.momentum, w.team);
    add_contacts(w.change, m, s, w, 1.0);
    const double target = residual_target(m, w, w.change, load);
    probe(StepPart::coupling);
    const double start = std::sqrt(numeric::dot(w.imbalance, w.imbalance, w.team));
    const numeric::SolveOutcome solve =
        improve_velocity(m, s, w, start > far * target ? forcing * start : target, product);
    outcome.tissue_solved = solve.residual_norm <= target;
    probe(StepPart::solve);
    add_contacts(w.imbalance, m, s, w, -1.0);
    product.add_rod(w.imbalance, s.velocity, 1.0);
    probe(StepPart::coupling);
    outcome.iterations += solve.iterations;
    if (solve.broke_down) return false;
  }
  w.rod.change = motion.residual;
  add_tissue_to(w.rod.change, m, s, w);
  motion.matrix.solve(w.rod.change.data());
  return true;
}

}  // namespace

RodOutcome solve_with_rod(const Model& m, State& s, Scratch& w, const needle::Pose& hub,
                          const StepProbe& probe) {
  const double h = m.scene.run.time_step;
  RodOutcome outcome;
  needle::RodMotion& motion = w.rod.motion;
  const Vec3& along = m.path.direction;
  const bool grip = m.grip_compliance > 0.0;
  needle::Pose first = hub;  // of the iterate: along the path a grip lets node 0 go on as it went
  if (grip)
    first.position +=
        along.dot(s.needle.rod.position[0] + h * three(s.needle.rod.rate, 0) - hub.position) * along;
  needle::begin_step(motion, m.rod, s.needle.rod, first, h);
  bool settled = false;
  double left_before = 0.0;
  for (int pass = 0; pass < max_passes; ++pass) {
    double left = 0.0;
    if (settled) {
      unbalance_into(motion.change, m, s, w, hub);
      const Vec3 by_hub = -three(motion.change, 0) / h;
      leave_to_hub(m, motion.change);
      left = imbalance(m, motion.change);
      if (left <= force_error && outcome.tissue_solved) {
        outcome.hub_force = by_hub;
        // A grip's pull is in balance already; what it holds across the path is left.
        if (grip) outcome.hub_force += (grip_pull(m, s, hub) - along.dot(by_hub)) * along;
        return outcome;
      }
    }
    if (!factor_rod(m, s, w, hub)) break;
    probe(StepPart::rod);
    // At a balance from which the rod is about to give way: it leaves it with each pass, by little more.
    const bool giving_way = settled && pass >= easy_passes && left > left_before &&
                            left > 4.0 * force_error && left < slight_force;
    if (settled) left_before = left;
    if (!m.rigid()) {
      numeric::copy_into(w.velocity_tried, s.velocity, w.team);
      numeric::copy_into(w.imbalance_tried, w.imbalance, w.team);
    }
    w.rod.before = s.needle.rod;
    probe(StepPart::coupling);
    if (!improve(m, s, w, outcome, probe)) break;
    go_part_of_the_way(m, s, w, 1.0);
    probe(StepPart::rod);
    settled = !correct_grips(m, s, w) && !giving_way;
    if (settled) {
      probe(StepPart::coupling);
      continue;
    }
    const double share = giving_way ? stride : line_search(m, s, w, hub);
    go_part_of_the_way(m, s, w, share);
    if (!m.rigid() && share != 1.0) {
      numeric::scale_and_add_into(s.velocity, share, w.velocity_tried, w.team);
      numeric::add_scaled_into(s.velocity, -share, w.velocity_tried, w.team);
      numeric::scale_and_add_into(w.imbalance, share, w.imbalance_tried, w.team);
      numeric::add_scaled_into(w.imbalance, -share, w.imbalance_tried, w.team);
    }
    correct_grips(m, s, w);
    probe(StepPart::coupling);
  }
  outcome.broke_down = true;
  return outcome;
}

double hub_stiffness(const Model& m, const State& s, Scratch& w) {
  const double h = m.scene.run.time_step;
  needle::RodMotion& motion = w.rod.motion;
  const Vec3& along = m.path.direction;
  linearise(m, s, w, s.needle.hub, 1.0);
  // The hub's column of the matrix: what the rod is asked when node 0 goes along the path at unit rate.
  std::vector<double>& hub_column = motion.residual;
  std::fill(hub_column.begin(), hub_column.end(), 0.0);
  for (int i = 0; i <= needle::rod_band + 2; ++i)
    for (int k = std::max(0, i - needle::rod_band); k < 3; ++k)
      hub_column[i] += motion.matrix.at(i, k) * along[k];
  double reaction = along.dot(three(hub_column, 0));
  needle::hold_hub(motion);
  if (!motion.matrix.factor()) return 0.0;
  std::vector<double>& answer = w.rod.free_answer;
  for (int i = 0; i < m.rod.unknowns(); ++i) answer[i] = i < 3 ? 0.0 : -hub_column[i];
  motion.matrix.solve(answer.data());
  if (!m.rigid()) {
    std::fill(w.stick_load.begin(), w.stick_load.end(), 0.0F);
    add_at(answer, 0, along);
    for (const RodContact& c : w.rod.contacts)
      coupling::add_spread(w.stick_load, *c.at, h * h * c.stiffness * at_contact(answer, c));
    add_at(answer, 0, -along);
    constexpr double tolerance = 1e-4;
    const double norm = std::sqrt(numeric::dot(w.stick_load, w.stick_load, w.team));
    const numeric::SolveOutcome outcome =
        numeric::solve_into(w.answer, w.stick_load, tolerance * norm, max_iterations, w.solver.single,
                            Product{m, w}, preconditioner(m, w), w.team);
    if (outcome.broke_down || outcome.iterations >= max_iterations) return 0.0;
    std::vector<double>& more = w.rod.load;
    std::fill(more.begin(), more.end(), 0.0);
    for (const RodContact& c : w.rod.contacts)
      add_to_rod(more, c, h * h * c.stiffness * coupling::mean(*c.at, w.answer));
    reaction -= along.dot(three(more, 0));
    motion.matrix.solve(more.data());
    for (int i = 3; i < m.rod.unknowns(); ++i) answer[i] += more[i];
  }
  for (int i = 3; i <= needle::rod_band + 2; ++i) reaction += hub_column[i] * answer[i];
  const double stiffness = std::max(reaction / (h * h), 0.0);
  return stiffness / (1.0 + stiffness * m.grip_compliance);
}

}  // namespace acus
