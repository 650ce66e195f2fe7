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
Side held_side(const Pose& pose) { return {pose.tangent, pose.director, 0.0}; }

// Energy of a node by the edges beside it, its gradient and the parts of its Hessian: a before the node, b
// behind it.
struct NodeTerms {
  double bending, twist;  // J
  Vec3 ga, gb;            // N, by the edge vectors
  double spin_a, spin_b;  // N m, by the spins
};

using numeric::Lane2;

// Three numbers and a zero, as two pairs: the registers of every machine.
struct Three {
  Lane2 xy{}, z{};

  Three() = default;
  ACUS_INLINE Three(Lane2 first, Lane2 second) : xy(first), z(second) {}
  ACUS_INLINE explicit Three(const Vec3& v) : xy{v[0], v[1]}, z{v[2], 0.0} {}
  ACUS_INLINE double operator[](int i) const { return i < 2 ? xy[i] : z[0]; }
  friend ACUS_INLINE Three operator+(const Three& u, const Three& v) { return {u.xy + v.xy, u.z + v.z}; }
  friend ACUS_INLINE Three operator-(const Three& u, const Three& v) { return {u.xy - v.xy, u.z - v.z}; }
  friend ACUS_INLINE Three operator*(double d, const Three& v) { return {d * v.xy, d * v.z}; }
};

// A matrix by its columns.
struct Block {
  Three x, y, z;

  friend ACUS_INLINE Block operator+(const Block& a, const Block& b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
  }
  friend ACUS_INLINE Block operator-(const Block& a, const Block& b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
  }
  friend ACUS_INLINE Block operator*(double d, const Block& b) { return {d * b.x, d * b.y, d * b.z}; }
};
ACUS_INLINE Block diagonal(double d) {
  return {{Lane2{d, 0.0}, Lane2{}}, {Lane2{0.0, d}, Lane2{}}, {Lane2{}, Lane2{d, 0.0}}};
}
ACUS_INLINE Block outer(const Three& u, const Three& v) { return {v[0] * u, v[1] * u, v[2] * u}; }  // u v^T
ACUS_INLINE Block outer_both_ways(const Three& u, const Three& v) { return outer(u, v) + outer(v, u); }
// v x, the matrix of a cross product
ACUS_INLINE Block cross(const Three& v) {
  return {{Lane2{0.0, v[2]}, Lane2{-v[1], 0.0}},
          {Lane2{-v[2], 0.0}, Lane2{v[0], 0.0}},
          {Lane2{v[1], -v[0]}, Lane2{}}};
}

// All times one factor.
struct SpinHessian {
  Three a, b;  // N, of one edge's spin by the two edge vectors
  double own;  // N m
};
struct NodeHessian {
  Block aa, ba, bb;  // N/m; the row is of b in ba
  SpinHessian sa, sb;
  double between;  // N m, of the spins
};

// 2 atan(x), for a twist of up to an eighth by the first terms of Gregory's series: what is left out is below
// 1e-18 of it.
double twice_arc(double x) {
  if (std::abs(x) > 0.0625) return 2.0 * numeric::atan(x);
  const double s = x * x;
  double sum = 1.0 / 13.0;
  for (const double term : {1.0 / 11.0, 1.0 / 9.0, 1.0 / 7.0, 1.0 / 5.0, 1.0 / 3.0, 1.0})
    sum = term - s * sum;
  return 2.0 * x * sum;
}

// Symbols: bend = EI / l_i, twist = GJ / l_i.
template <bool with_hessian>
NodeTerms node_terms(const Side& a, const Side& b, double bend, double twist,
                     const std::array<double, 2>& natural, double factor, double compression,
                     NodeHessian* h) {
  NodeTerms out;
  const double c = a.tangent.dot(b.tangent);
  const double inverse = 1.0 / (1.0 + c);
  const Vec3 kb = (2.0 * inverse) * a.tangent.cross(b.tangent);
  const Vec3 mean = inverse * (a.tangent + b.tangent);

  // |kb|^2 = 4 (1 - c) / (1 + c)
  const double slope = -4.0 * bend * inverse * inverse;
  const Vec3 ua = b.tangent - c * a.tangent;  // dc/da |a|
  const Vec3 ub = a.tangent - c * b.tangent;

  // k0 . k = kb . (fa + fb) / 2: k0 in the directors of either edge, a quarter turn from there, and both
  // together.
  const Vec3 a2 = a.tangent.cross(a.director), b2 = b.tangent.cross(b.director);
  const Vec3 fa = natural[0] * a2 - natural[1] * a.director, fb = natural[0] * b2 - natural[1] * b.director;
  const Vec3 qa = natural[0] * a.director + natural[1] * a2, qb = natural[0] * b.director + natural[1] * b2;
  const Vec3 f = inverse * (fa + fb);
  const double along = 0.5 * kb.dot(fa + fb), across_a = 0.5 * kb.dot(qa), across_b = 0.5 * kb.dot(qb);
  const Vec3 pa = along * mean - b.tangent.cross(f), pb = along * mean + a.tangent.cross(f);

  const Vec3 carried = a.director - b.tangent.dot(a.director) * mean;
  const double turn = twice_arc(b.tangent.dot(carried.cross(b.director)) / (1.0 + carried.dot(b.director)));
  const double torque = twist * turn;

  out.bending =
      bend * (2.0 * (1.0 - c) * inverse + 0.5 * (natural[0] * natural[0] + natural[1] * natural[1]) - along);
  out.twist = 0.5 * torque * turn;
  out.ga = a.inverse_length * (slope * ua + bend * pa + (0.5 * torque) * kb);
  out.gb = b.inverse_length * (slope * ub + bend * pb + (0.5 * torque) * kb);
  out.spin_a = bend * across_a - torque;
  out.spin_b = bend * across_b + torque;

  if constexpr (with_hessian) {
    const double la = a.inverse_length, lb = b.inverse_length;
    const double s = factor * slope, curve = -2.0 * s * inverse, t = factor * twist, q = factor * torque;
    const double n = -factor * compression * bend, bent = n * along * inverse;
    const Three k(kb), ta(a.tangent), tb(b.tangent), va(ua), vb(ub), m(mean);
    // Times |a|^2, |b|^2 and |a| |b|.
    const auto own = [&](const Vec3& tangent, const Vec3& u, const Vec3& p, const Vec3& fall) {
      const Three x(tangent), y(u);
      const double in_line = s * c + bent;
      return diagonal(-in_line) + outer(x, in_line * x) + outer_both_ways(y, 0.5 * curve * y - s * x) +
             outer_both_ways(k, (0.125 * t) * k - (0.25 * q) * (x + m) + (0.25 * n) * Three(fall)) +
             outer_both_ways(m, n * Three(p));
    };
    h->aa = (la * la) * own(a.tangent, ua, pa, fa);
    h->bb = (lb * lb) * own(b.tangent, ub, pb, fb);
    h->ba = (la * lb) * (diagonal(s - bent) + outer(vb, curve * va - s * ta) - outer(tb, s * tb + bent * ta) +
                         outer((0.25 * t) * k - (0.5 * q) * m, k) + outer(m, n * Three(pa)) +
                         outer(n * Three(pb), m) + cross(n * Three(f) - (q * inverse) * ta));
    const auto spin = [&](const Vec3& quarter, double across, const Vec3& fall, double sign) {
      const Vec3 from_a = n * (across * mean - inverse * b.tangent.cross(quarter));
      const Vec3 from_b = n * (across * mean + inverse * a.tangent.cross(quarter));
      return SpinHessian{la * (Three(from_a) + (0.5 * sign * t) * k),
                         lb * (Three(from_b) + (0.5 * sign * t) * k), t - 0.5 * n * kb.dot(fall)};
    };
    h->sa = spin(qa, across_a, fa, -1.0);
    h->sb = spin(qb, across_b, fb, 1.0);
    h->between = -t;
  }
  return out;
}

void add(std::vector<double>& to, int at, const Vec3& v) {
  for (int k = 0; k < 3; ++k) to[at + k] += v[k];
}

// Adds to the three entries from (row, column) down.
ACUS_INLINE void add(RodMatrix& m, int row, int column, const Three& v) {
  m.add(row, column, v.xy);
  m.add(row + 2, column, v.z[0]);
}
// A block below the diagonal; one on it, by its lower half.
ACUS_INLINE void add(RodMatrix& m, int row, int column, const Block& b) {
  add(m, row, column, b.x);
  add(m, row, column + 1, b.y);
  add(m, row, column + 2, b.z);
}
ACUS_INLINE void add_symmetric(RodMatrix& m, int at, const Block& b) {
  add(m, at, at, b.x);
  m.add(at + 1, at + 1, Lane2{b.y[1], b.y[2]});
  m.add(at + 2, at + 2, b.z[2]);
}
// A place by the spin of the edge before or behind it.
ACUS_INLINE void add_spin(RodMatrix& m, int place, int spin, const Three& v) {
  if (place > spin) return add(m, place, spin, v);
  for (int c = 0; c < 3; ++c) m.add(spin, place + c, v[c]);
}

// Of edge j by its own vector.
ACUS_INLINE void add_edge(RodMatrix& m, int j, const Block& own) {
  add_symmetric(m, place_at(j), own);
  add_symmetric(m, place_at(j + 1), own);
  add(m, place_at(j + 1), place_at(j), -1.0 * own);
}

// Hessian of node i by the two edges at once, and by the spins of the edges beside it.
ACUS_INLINE void add_node(RodMatrix& m, const Rod& rod, int i, const NodeHessian& h) {
  const bool before = i > 0, behind = i < rod.edges;  // which edges are the rod's, and not a clamp's
  const int p = place_at(i - 1), q = place_at(i), r = place_at(i + 1);
  const int sa = spin_at(i - 1), sb = spin_at(i);
  if (before) {
    m.add(sa, sa, h.sa.own);
    add_spin(m, p, sa, -1.0 * h.sa.a);
    add_spin(m, q, sa, h.sa.a - h.sa.b);
  }
  if (behind) {
    m.add(sb, sb, h.sb.own);
    add_spin(m, q, sb, h.sb.a - h.sb.b);
    add_spin(m, r, sb, h.sb.b);
  }
  if (before && behind) {
    const Block across = -1.0 * h.ba;
    const Three& x = across.x;
    const Three& y = across.y;
    const Three& z = across.z;
    add_symmetric(m, q,
                  {{x.xy + Lane2{x[0], y[0]}, x.z + Lane2{z[0], 0.0}},
                   {Lane2{0.0, 2.0 * y[1]}, Lane2{y[2] + z[1], 0.0}},
                   {Lane2{}, Lane2{2.0 * z[2], 0.0}}});
    add(m, q, p, h.ba);
    add(m, r, q, h.ba);
    add(m, r, p, across);
    m.add(sb, sa, h.between);
    add_spin(m, p, sb, -1.0 * h.sb.a);
    add_spin(m, r, sa, h.sa.b);
  }
}

// Edge i with its tension and stiffness.
struct Stretched {
  Side side;
  Vec3 tension;   // N
  double energy;  // J
};
template <bool with_matrix>
Stretched stretched(const Rod& rod, const RodState& s, int i, double factor, double compression,
                    Block* stiffness) {
  const Vec3 e = edge(s, i);
  const double length = e.norm(), inverse = 1.0 / length;
  const Vec3 tangent = inverse * e;
  const double rigidity = rod.axial / rod.edge_length[i];
  const double excess = length - rod.edge_length[i];
  const double tension = rigidity * excess;
  if constexpr (with_matrix) {
    const double geometric = (tension < 0.0 ? compression * tension : tension) * inverse;
    const Three t(tangent);
    *stiffness = diagonal(factor * geometric) + outer(t, (factor * (rigidity - geometric)) * t);
  }
  return {{tangent, s.director[i], inverse}, tension * tangent, 0.5 * tension * excess};
}

template <bool with_matrix>
RodEnergy forces(std::vector<double>& f, RodMatrix* matrix, double factor, double compression, const Rod& rod,
                 const RodState& s, const Pose& hub, const Pose& tip) {
  RodEnergy energy;
  std::fill(f.begin(), f.end(), 0.0);
  const auto push = [&](int node, const Vec3& force) { add(f, place_at(node), force); };
  Side before = held_side(hub);
  Block own_before, own_behind;  // of the edges by their own vectors
  for (int i = 0; i <= rod.edges; ++i) {
    const bool last = i == rod.edges;
    Side behind = held_side(tip);
    if (!last) {
      const Stretched edge = stretched<with_matrix>(rod, s, i, factor, compression, &own_behind);
      energy.stretch += edge.energy;
      push(i, edge.tension);
      push(i + 1, -edge.tension);
      behind = edge.side;
    }
    if (!last || rod.tip_clamped) {
      // A pinned hub hinders spinning alone.
      const double inverse = 1.0 / rod.node_length[i];
      const double bend = i > 0 || rod.hub_clamped ? rod.bending * inverse : 0.0;
      const double twist = rod.torsion * inverse;
      NodeHessian hessian;
      const NodeTerms n = node_terms<with_matrix>(before, behind, bend, twist, rod.natural_turning[i], factor,
                                                  compression, &hessian);
      energy.bending += n.bending;
      energy.twist += n.twist;
      if (i > 0) {
        push(i - 1, n.ga);
        push(i, -n.ga);
        f[spin_at(i - 1)] -= n.spin_a;
      }
      if (!last) {
        push(i, n.gb);
        push(i + 1, -n.gb);
        f[spin_at(i)] -= n.spin_b;
      }
      if constexpr (with_matrix) {
        add_node(*matrix, rod, i, hessian);
        if (i > 0) own_before = own_before + hessian.aa;
        if (!last) own_behind = own_behind + hessian.bb;
      }
    }
    if constexpr (with_matrix) {
      if (i > 0) add_edge(*matrix, i - 1, own_before);
      own_before = own_behind;
    }
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
  const Side first{edge(s, 0).normalized(), s.director[0], 0.0};
  const double bend = rod.hub_clamped ? rod.bending / rod.node_length[0] : 0.0;
  const NodeTerms n = node_terms<false>(held, first, bend, rod.torsion / rod.node_length[0],
                                        rod.natural_turning[0], 0.0, 0.0, nullptr);
  return hub.tangent.cross(n.ga) + n.spin_a * hub.tangent;
}

}  // namespace acus::needle
