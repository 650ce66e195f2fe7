#include "acus/sim/rod_solve.h"

#include <algorithm>
#include <cmath>

#include "acus/sim/rod_contact.h"
#include "acus/sim/tissue_step.h"

namespace acus {
namespace {

using numeric::NodeVector;

constexpr int max_passes = 40;         // of Newton's method and the branches together; two are usual
constexpr int max_iterations = 4000;   // of one conjugate-gradient solve
constexpr double force_error = 1e-6;   // N, and N per metre of the rod for moments: what may be left unbalanced

void add_at(std::vector<double>& to, int at, const Vec3& v) {
  for (int k = 0; k < 3; ++k) to[at + k] += v[k];
}
Vec3 three(const std::vector<double>& from, int at) { return {from[at], from[at + 1], from[at + 2]}; }

// to += J^T v for one contact, and J x.
void add_to_rod(std::vector<double>& to, const RodContact& c, const Vec3& v) {
  add_at(to, needle::place_at(c.point.edge), (1.0 - c.point.along) * v);
  add_at(to, needle::place_at(c.point.edge + 1), c.point.along * v);
}
Vec3 of_rod(const std::vector<double>& x, const RodContact& c) {
  return (1.0 - c.point.along) * three(x, needle::place_at(c.point.edge)) +
         c.point.along * three(x, needle::place_at(c.point.edge + 1));
}

void add_block(needle::RodMatrix& matrix, int row, int column, const Mat3& block) {
  for (int r = 0; r < 3; ++r)
    for (int k = 0; k < 3; ++k)
      if (row + r >= column + k) matrix.add(row + r, column + k, block(r, k));
}

// Newton's system of the rod at the iterate while the tissue rests, factored. What edges under compression take from
// the matrix is let go by and by where it is not definite.
bool load_rod(const Model& m, const State& s, Scratch& w, const needle::Pose& hub) {
  const double h = m.scene.run.time_step;
  needle::RodMotion& motion = w.rod.motion;
  for (double compression = 1.0;; compression = compression > 0.1 ? 0.5 * compression : 0.0) {
    needle::linearise(motion, m.rod, s.needle.rod, hub, needle::Pose{m.path.entry, m.path.direction, hub.director}, h, compression);
    for (const RodContact& c : w.rod.contacts) {
      const int a = needle::place_at(c.point.edge), b = needle::place_at(c.point.edge + 1);
      const double wa = 1.0 - c.point.along, wb = c.point.along;
      add_block(motion.matrix, a, a, h * h * wa * wa * c.stiffness);
      add_block(motion.matrix, b, a, h * h * wb * wa * c.stiffness);
      add_block(motion.matrix, b, b, h * h * wb * wb * c.stiffness);
      add_to_rod(motion.residual, c, h * (c.force - h * c.stiffness * of_rod(s.needle.rod.rate, c)));
    }
    if (m.grip_compliance > 0.0) {
      const Vec3& along = m.path.direction;
      const double stiffness = 1.0 / m.grip_compliance;
      constexpr double heavy = 1e20;  // kg: nothing moves it sideways
      const Mat3 axial = along * along.transpose();
      add_block(motion.matrix, 0, 0, h * h * stiffness * axial + heavy * (Mat3::Identity() - axial));
      add_at(motion.residual, 0, h * stiffness * along.dot(hub.position - s.needle.rod.position[0]) * along);
    } else {
      needle::hold_hub(motion);
    }
    if (motion.matrix.factor()) return true;
    if (compression == 0.0) return false;
  }
}

// h^2 J^T K C v: what moving tissue does to the rod.
void add_tissue_to(std::vector<double>& load, const Model& m, const State& s, const Scratch& w) {
  const double h = m.scene.run.time_step;
  if (m.rigid()) return;
  for (const RodContact& c : w.rod.contacts) add_to_rod(load, c, h * h * c.stiffness * tissue_rate(s, c));
}

// N, the largest force or moment per length of the rod that is out of balance, but for what the hub holds.
double imbalance(const Model& m, const std::vector<double>& load) {
  const double arm = m.rod.edge_length.front();
  double largest = 0.0;
  for (int i = m.grip_compliance > 0.0 ? 0 : 3; i < m.rod.unknowns(); ++i)
    largest = std::max(largest, std::abs(load[i]) / (needle::is_spin(i) ? arm : 1.0));
  return largest / m.scene.run.time_step;
}

// y = A x with the rod's answer.
struct Product {
  const Model& m;
  Scratch& w;
  void operator()(NodeVector& y, const NodeVector& x) const {
    tissue::multiply_into(y, m.tissue, w.corotation, w.matrix, x);
    add_rod(y, x);
  }
  void operator()(numeric::NodeVectorOf<float>& y, const numeric::NodeVectorOf<float>& x) const {
    tissue::multiply_into(y, m.tissue, w.matrix, x);
    add_rod(y, x);
  }
  template <class Real>
  void add_rod(numeric::NodeVectorOf<Real>& y, const numeric::NodeVectorOf<Real>& x) const {
    const double h = m.scene.run.time_step;
    std::vector<double>& z = w.rod.load;
    std::fill(z.begin(), z.end(), 0.0);
    for (const RodContact& c : w.rod.contacts) {
      const Vec3 pull = h * h * c.stiffness * coupling::mean(*c.at, x);
      coupling::add_spread(y, *c.at, pull);
      add_to_rod(z, c, pull);
    }
    w.rod.motion.matrix.solve(z.data());
    for (const RodContact& c : w.rod.contacts)
      coupling::add_spread(y, *c.at, -h * h * c.stiffness * of_rod(z, c));
  }
};

void load_tissue(const Model& m, const State& s, Scratch& w) {
  const double h = m.scene.run.time_step;
  w.right_hand_side = w.momentum;
  for (const RodContact& c : w.rod.contacts) {
    const Vec3 rate = of_rod(s.needle.rod.rate, c) + of_rod(w.rod.free_answer, c);
    coupling::add_spread(w.right_hand_side, *c.at, h * (h * c.stiffness * rate - c.force));
  }
}

}  // namespace

RodOutcome solve_with_rod(const Model& m, State& s, Scratch& w, const needle::Pose& hub) {
  const double h = m.scene.run.time_step;
  RodOutcome outcome;
  needle::RodMotion& motion = w.rod.motion;
  needle::Pose first = hub;  // of the iterate
  if (m.grip_compliance > 0.0) first.position = s.needle.rod.position[0] + h * three(s.needle.rod.rate, 0);
  needle::begin_step(motion, m.rod, s.needle.rod, first, h);
  bool settled = false;
  for (int pass = 0; pass < max_passes; ++pass) {
    if (!load_rod(m, s, w, hub)) break;
    motion.change = motion.residual;
    add_tissue_to(motion.change, m, s, w);
    if (settled && imbalance(m, motion.change) <= force_error) {
      outcome.hub_force = -three(motion.change, 0) / h;
      if (m.grip_compliance > 0.0)
        outcome.hub_force = m.path.direction.dot(hub.position - s.needle.rod.position[0]) / m.grip_compliance * m.path.direction;
      return outcome;
    }
    if (!m.rigid()) {
      w.rod.free_answer = motion.residual;
      motion.matrix.solve(w.rod.free_answer.data());
      load_tissue(m, s, w);
      const double norm = std::sqrt(numeric::dot(w.right_hand_side, w.right_hand_side));
      const numeric::CgOutcome solve =
          numeric::solve_refined_into(s.velocity, w.right_hand_side, m.scene.run.solver_tolerance * norm, max_iterations,
                                      w.solver, Product{m, w}, preconditioner(m, w));
      outcome.iterations += solve.iterations;
      if (solve.broke_down || solve.iterations >= max_iterations) break;
      motion.change = motion.residual;
      add_tissue_to(motion.change, m, s, w);
    }
    motion.matrix.solve(motion.change.data());
    needle::apply_change(motion, m.rod, s.needle.rod, h);
    settled = !correct_grips(m, s, w);
  }
  outcome.broke_down = true;
  return outcome;
}

}  // namespace acus
