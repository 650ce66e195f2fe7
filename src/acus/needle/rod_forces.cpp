#include "acus/needle/rod_forces.h"

#include <algorithm>
#include <cmath>

#include "acus/numeric/circular.h"

namespace acus::needle {
namespace {

// One of the two edges that meet at a node; `inverse_length` is 0 for a half edge in a clamp, which does not
// give.
struct Side {
  Vec3 tangent;
  Vec3 director;
  double inverse_length;
};

// Energy of a node by the edges beside it, its gradient and the parts of its Hessian: a before the node, b
// behind it.
struct NodeTerms {
  double bending = 0.0, twist = 0.0;  // J
  Vec3 ga, gb;                        // N, by the edge vectors
  double spin_a = 0.0, spin_b = 0.0;  // N m, by the spins
};
struct NodeHessian {
  Mat3 aa, ab, bb;        // N/m; the row is of a in ab
  Vec3 twist_a, twist_b;  // 1/m, of the director's turn by the edge vectors; by the spins it is -1 and 1
};

// Symbols: bend = EI / l_i, twist = GJ / l_i.
template <bool with_hessian>
NodeTerms node_terms(const Side& a, const Side& b, double bend, double twist,
                     const std::array<double, 2>& natural, NodeHessian* h) {
  NodeTerms out;
  const double c = a.tangent.dot(b.tangent);
  const double chi = 1.0 + c;
  const Vec3 kb = (2.0 / chi) * a.tangent.cross(b.tangent);
  const Vec3 mean_tangent = (a.tangent + b.tangent) / chi;

  // |kb|^2 = 4 (1 - c) / (1 + c)
  const double slope = -4.0 * bend / (chi * chi);
  const Vec3 ua = b.tangent - c * a.tangent;  // dc/da |a|
  const Vec3 ub = a.tangent - c * b.tangent;
  out.bending = 2.0 * bend * (1.0 - c) / chi;
  out.ga = slope * a.inverse_length * ua;
  out.gb = slope * b.inverse_length * ub;

  if (natural[0] != 0.0 || natural[1] != 0.0) {
    const Vec3 a2 = a.tangent.cross(a.director), b2 = b.tangent.cross(b.director);
    const double k1 = 0.5 * kb.dot(a2 + b2), k2 = -0.5 * kb.dot(a.director + b.director);
    const Vec3 d1 = (a.director + b.director) / chi, d2 = (a2 + b2) / chi;
    out.bending += bend * (0.5 * (natural[0] * natural[0] + natural[1] * natural[1]) - natural[0] * k1 -
                           natural[1] * k2);
    const Vec3 fall = natural[0] * d2 - natural[1] * d1;  // k0 . grad k
    const double along = natural[0] * k1 + natural[1] * k2;
    out.ga -= bend * a.inverse_length * (b.tangent.cross(fall) - along * mean_tangent);
    out.gb -= bend * b.inverse_length * (-a.tangent.cross(fall) - along * mean_tangent);
    out.spin_a += 0.5 * bend * (natural[0] * kb.dot(a.director) + natural[1] * kb.dot(a2));
    out.spin_b += 0.5 * bend * (natural[0] * kb.dot(b.director) + natural[1] * kb.dot(b2));
  }

  const Vec3 carried = transported(a.director, a.tangent, b.tangent);
  const double turn =
      2.0 * numeric::atan(b.tangent.dot(carried.cross(b.director)) / (1.0 + carried.dot(b.director)));
  const Vec3 ta = 0.5 * a.inverse_length * kb, tb = 0.5 * b.inverse_length * kb;
  const double torque = twist * turn;
  out.twist = 0.5 * torque * turn;
  out.ga += torque * ta;
  out.gb += torque * tb;
  out.spin_a -= torque;
  out.spin_b += torque;

  if constexpr (with_hessian) {
    const double curve = 8.0 * bend / (chi * chi * chi);
    const auto across = [](const Vec3& t) { return Mat3(Mat3::Identity() - t * t.transpose()); };
    const Mat3 pa = across(a.tangent), pb = across(b.tangent);
    const double la = a.inverse_length, lb = b.inverse_length;
    const Mat3 uta = ua * a.tangent.transpose(), utb = ub * b.tangent.transpose();
    h->aa = la * la * (curve * ua * ua.transpose() - slope * (uta + uta.transpose() + c * pa));
    h->bb = lb * lb * (curve * ub * ub.transpose() - slope * (utb + utb.transpose() + c * pb));
    h->ab = la * lb * (curve * ua * ub.transpose() + slope * pa * pb);
    h->twist_a = ta;
    h->twist_b = tb;
    h->aa += twist * ta * ta.transpose();
    h->bb += twist * tb * tb.transpose();
    h->ab += twist * ta * tb.transpose();
    if (torque != 0.0) {
      const Mat3 ka = kb * (a.tangent + mean_tangent).transpose(),
                 kbb = kb * (b.tangent + mean_tangent).transpose();
      Mat3 skew;
      skew << 0.0, -a.tangent.z(), a.tangent.y(), a.tangent.z(), 0.0, -a.tangent.x(), -a.tangent.y(),
          a.tangent.x(), 0.0;
      h->aa -= (0.25 * torque * la * la) * (ka + ka.transpose());
      h->bb -= (0.25 * torque * lb * lb) * (kbb + kbb.transpose());
      h->ab += (0.5 * torque * la * lb) * ((2.0 / chi) * skew - kb * mean_tangent.transpose());
    }
  }
  return out;
}

// The edges in order, with what a clamp holds at both ends: sides[i] and sides[i + 1] meet at node i.
Side side_of(const RodState& s, int j) {
  const Vec3 e = edge(s, j);
  const double inverse = 1.0 / e.norm();
  return {e * inverse, s.director[j], inverse};
}
Side held_side(const Pose& pose) { return {pose.tangent, pose.director, 0.0}; }

void add(std::vector<double>& to, int at, const Vec3& v) {
  for (int k = 0; k < 3; ++k) to[at + k] += v[k];
}

void add_block(RodMatrix& m, int row, int column, const Mat3& block) {
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c)
      if (row + r >= column + c) m.add(row + r, column + c, block(r, c));
}
void add_column(RodMatrix& m, int row, int column, const Vec3& block) {
  for (int r = 0; r < 3; ++r)
    row + r >= column ? m.add(row + r, column, block[r]) : m.add(column, row + r, block[r]);
}

// Adds factor * Hessian of node i by the places of nodes i - 1, i, i + 1 and the spins of the edges between.
void scatter(RodMatrix& m, const Rod& rod, int i, const NodeHessian& h, double twist, double factor) {
  const bool before = i > 0, behind = i < rod.edges;  // which edges are the rod's, and not a clamp's
  const Mat3 aa = factor * h.aa, ab = factor * h.ab, bb = factor * h.bb;
  const Vec3 a = factor * twist * h.twist_a, b = factor * twist * h.twist_b;
  const double t = factor * twist;
  const int p = place_at(i - 1), q = place_at(i), r = place_at(i + 1);
  const int sa = spin_at(i - 1), sb = spin_at(i);
  // An edge in a clamp does not change: its terms are zero.
  add_block(m, q, q, aa - ab - ab.transpose() + bb);
  if (before) {
    add_block(m, p, p, aa);
    add_block(m, q, p, ab.transpose() - aa);
    m.add(sa, sa, t);
    add_column(m, p, sa, a);
    add_column(m, q, sa, b - a);
    if (behind) add_column(m, r, sa, -b);
  }
  if (behind) {
    add_block(m, r, r, bb);
    add_block(m, r, q, ab.transpose() - bb);
    m.add(sb, sb, t);
    add_column(m, q, sb, a - b);
    add_column(m, r, sb, b);
  }
  if (before && behind) {
    add_block(m, r, p, -ab.transpose());
    add_column(m, p, sb, -a);
    m.add(sb, sa, -t);
  }
}

template <bool with_matrix>
RodEnergy forces(std::vector<double>& f, RodMatrix* matrix, double factor, double compression, const Rod& rod,
                 const RodState& s, const Pose& hub, const Pose& tip) {
  RodEnergy energy;
  std::fill(f.begin(), f.end(), 0.0);
  const auto push = [&](int node, const Vec3& force) { add(f, place_at(node), force); };
  Side before = held_side(hub);
  for (int i = 0; i <= rod.edges; ++i) {
    const bool last = i == rod.edges;
    const Side behind = last ? held_side(tip) : side_of(s, i);
    if (!last) {
      const double length = 1.0 / behind.inverse_length;
      const double strain = length / rod.edge_length[i] - 1.0;
      const Vec3 tension = rod.axial * strain * behind.tangent;
      energy.stretch += 0.5 * rod.axial * rod.edge_length[i] * strain * strain;
      push(i, tension);
      push(i + 1, -tension);
      if constexpr (with_matrix) {
        const Mat3 tt = behind.tangent * behind.tangent.transpose();
        const double counted = strain < 0.0 ? compression * strain : strain;
        const double geometric = rod.axial * counted * behind.inverse_length;
        const Mat3 k =
            factor * (geometric * Mat3::Identity() + (rod.axial / rod.edge_length[i] - geometric) * tt);
        add_block(*matrix, place_at(i + 1), place_at(i + 1), k);
        add_block(*matrix, place_at(i), place_at(i), k);
        add_block(*matrix, place_at(i + 1), place_at(i), -k);
      }
    }
    if (last && !rod.tip_clamped) break;
    // A pinned hub hinders spinning alone.
    const bool bends = i > 0 || rod.hub_clamped;
    const double bend = bends ? rod.bending / rod.node_length[i] : 0.0;
    const double twist = rod.torsion / rod.node_length[i];
    NodeHessian hessian;
    const NodeTerms n =
        node_terms<with_matrix>(before, behind, bend, twist, rod.natural_turning[i], &hessian);
    energy.bending += n.bending;
    energy.twist += n.twist;
    if (i > 0) {
      push(i - 1, n.ga);
      push(i, -n.ga);
      f[spin_at(i - 1)] -= n.spin_a;
    }
    push(i, n.gb);
    if (!last) {
      push(i + 1, -n.gb);
      f[spin_at(i)] -= n.spin_b;
    }
    if constexpr (with_matrix) scatter(*matrix, rod, i, hessian, twist, factor);
    before = behind;
  }
  return energy;
}

}  // namespace

RodEnergy rod_forces_into(std::vector<double>& f, const Rod& rod, const RodState& s, const Pose& hub,
                          const Pose& tip) {
  return forces<false>(f, nullptr, 0.0, 0.0, rod, s, hub, tip);
}

RodEnergy rod_forces_into(std::vector<double>& f, RodMatrix& matrix, double factor, double compression,
                          const Rod& rod, const RodState& s, const Pose& hub, const Pose& tip) {
  return forces<true>(f, &matrix, factor, compression, rod, s, hub, tip);
}

Vec3 hub_moment(const Rod& rod, const RodState& s, const Pose& hub) {
  Side held = held_side(hub);
  held.inverse_length = 1.0;  // the gradient by the clamp's tangent
  const double bend = rod.hub_clamped ? rod.bending / rod.node_length[0] : 0.0;
  const NodeTerms n = node_terms<false>(held, side_of(s, 0), bend, rod.torsion / rod.node_length[0],
                                        rod.natural_turning[0], nullptr);
  return hub.tangent.cross(n.ga) + n.spin_a * hub.tangent;
}

}  // namespace acus::needle
