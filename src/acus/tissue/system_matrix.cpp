#include "acus/tissue/system_matrix.h"

#include <algorithm>
#include <cstring>

#include "acus/tissue/lanes.h"

namespace acus::tissue {
namespace {

using numeric::load4;
using numeric::load_lanes;
using numeric::node_stride;
using numeric::store4;

// Numbers of eight elements, straight from where they are kept, part by part.
class ExactElements {
 public:
  using Real = double;
  using Lane = ExactLane;
  ACUS_INLINE ExactElements(const TissueModel& m, const Corotation& corotation, double factor)
      : gradient_(corotation.rotated_gradient.data()),
        volume_(m.volume.data()),
        shear_(m.step_shear.data()),
        lambda_(m.step_lambda.data()),
        factor_(factor) {}
  ACUS_INLINE void go_to(std::size_t first, int part) {
    const int skipped = part * lanes_in<Real, Lane>;
    batch_ = gradient_ + 9 * first + skipped;
    first_ = first + skipped;
  }
  // q_1, q_2, q_3, component by component
  ACUS_INLINE Lane q(int k) const { return load_part<Lane>(batch_ + k * lanes); }
  ACUS_INLINE Lane mu_v() const { return factor_ * load_part<Lane>(shear_ + first_) * volume(); }
  ACUS_INLINE Lane lambda_v() const { return factor_ * load_part<Lane>(lambda_ + first_) * volume(); }
  ACUS_INLINE Lane quarter_v() const { return 0.25 * volume(); }

 private:
  ACUS_INLINE Lane volume() const { return load_part<Lane>(volume_ + first_); }
  const double *gradient_, *volume_, *shear_, *lambda_;
  double factor_;
  const double* batch_ = nullptr;
  std::size_t first_ = 0;
};

// Those of sixteen, packed, part by part.
class PackedElements {
 public:
  using Real = float;
  using Lane = PackedLane;
  ACUS_INLINE explicit PackedElements(const SystemMatrix& a) : element_(a.element.data()) {}
  ACUS_INLINE void go_to(std::size_t first, int part) {
    first_ = element_ + first * element_numbers + part * lanes_in<Real, Lane>;
  }
  ACUS_INLINE Lane q(int k) const { return load_part<Lane>(first_ + k * padding); }
  ACUS_INLINE Lane mu_v() const { return q(9); }
  ACUS_INLINE Lane lambda_v() const { return q(10); }
  ACUS_INLINE Lane quarter_v() const { return q(11); }

 private:
  const float* element_;
  const float* first_ = nullptr;
};

// The edges x_i - x_0 of a field on the elements, i = 1 .. 3, component by component.
template <class Real, class Lane>
ACUS_INLINE void gather_edges(Lane* edge, const Real* field, const mesh::Tet* offsets) {
  Lane origin[4], corner[4];
  gather_corner(origin, field, offsets, 0);
  for (int i = 0; i < 3; ++i) {
    gather_corner(corner, field, offsets, i + 1);
    for (int c = 0; c < 3; ++c) edge[3 * i + c] = corner[c] - origin[c];
  }
}

// Calls `respond` for the parts of each batch of elements with the part's own `offsets`, and adds up what it
// puts.
template <class Elements, class Respond, class Real = typename Elements::Real>
ACUS_INLINE void add_elements(const TissueModel& m, Elements s, Real* reaction, const Respond& respond) {
  using Lane = typename Elements::Lane;
  constexpr int parts = lane_count<Real> / lanes_in<Real, Lane>;
  for (std::size_t first = 0; first < m.offsets.size(); first += lane_count<Real>) {
    const mesh::Tet* offsets = m.offsets.data() + first;
    BatchSum<Real, Lane> sum(reaction, offsets);
    for (int part = 0; part < parts; ++part) {
      s.go_to(first, part);
      respond(
          s, offsets + part * lanes_in<Real, Lane>,
          [&](int i, const Lane* force) __attribute__((always_inline)) { sum.take(part, i, force); });
    }
    sum.finish();
  }
}

// Adds what the elements do by themselves and, `with_dilation`, beside it V tr(G) / 4 for the nodes' means.
template <bool with_dilation, class Elements, class Real = typename Elements::Real>
ACUS_INLINE void add_local(const TissueModel& m, const Elements& elements, const Real* field,
                           Real* reaction) {
  using Lane = typename Elements::Lane;
  add_elements(
      m, elements, reaction,
      [&](const Elements& s, const mesh::Tet* offsets, const auto& put) __attribute__((always_inline)) {
        Lane edge[9], g[9];  // entry (r, c) of G at 3 c + r
        gather_edges(edge, field, offsets);
        for (int c = 0; c < 3; ++c)
          for (int r = 0; r < 3; ++r)
            g[3 * c + r] = edge[r] * s.q(c) + edge[3 + r] * s.q(3 + c) + edge[6 + r] * s.q(6 + c);
        const Lane trace = g[0] + g[4] + g[8];
        const Lane mu = s.mu_v(), two_mu = mu + mu, bulk = s.lambda_v() * trace;
        const Lane xx = two_mu * g[0] + bulk, yy = two_mu * g[4] + bulk, zz = two_mu * g[8] + bulk;
        const Lane xy = mu * (g[1] + g[3]), xz = mu * (g[2] + g[6]), yz = mu * (g[5] + g[7]);
        Lane force[4][4];
        for (int i = 0; i < 3; ++i) {
          const Lane qx = s.q(3 * i), qy = s.q(3 * i + 1), qz = s.q(3 * i + 2);
          force[i + 1][0] = xx * qx + xy * qy + xz * qz;
          force[i + 1][1] = xy * qx + yy * qy + yz * qz;
          force[i + 1][2] = xz * qx + yz * qy + zz * qz;
        }
        for (int c = 0; c < 3; ++c) force[0][c] = -(force[1][c] + force[2][c] + force[3][c]);
        for (int i = 0; i < 4; ++i) {
          force[i][3] = with_dilation ? s.quarter_v() * trace : Lane{};
          put(i, force[i]);
        }
      });
}

// Adds what the nodal pressures do: f_i += (V / 4) (sum over the corners of the pressure) q_i. A pressure
// stands beside its node's x, where one load brings both.
template <class Elements, class Real = typename Elements::Real>
ACUS_INLINE void add_pressure(const TissueModel& m, const Elements& elements, const Real* field,
                              Real* reaction) {
  using Lane = typename Elements::Lane;
  add_elements(
      m, elements, reaction,
      [&](const Elements& s, const mesh::Tet* offsets, const auto& put) __attribute__((always_inline)) {
        Lane sum[4], force[4][4];
        sum_corners(sum, field, offsets);
        const Lane bulk = s.quarter_v() * sum[3];
        for (int i = 0; i < 3; ++i)
          for (int c = 0; c < 3; ++c) force[i + 1][c] = bulk * s.q(3 * i + c);
        for (int c = 0; c < 3; ++c) force[0][c] = -(force[1][c] + force[2][c] + force[3][c]);
        for (int i = 0; i < 4; ++i) {
          force[i][3] = Lane{};
          put(i, force[i]);
        }
      });
}

// reaction = K' field; `pressure_weight(n)` is kappa_n / V_n with the factor.
template <class Elements, class Weight, class Real = typename Elements::Real>
ACUS_INLINE void react(const TissueModel& m, const Elements& elements, const Weight& pressure_weight,
                       Real* field, Real* reaction) {
  if (m.kind == ElementKind::linear) return add_local<false>(m, elements, field, reaction);
  add_local<true>(m, elements, field, reaction);
  for (int n = 0; n < m.nodes; ++n) {
    Real& dilation = reaction[node_stride * n + 3];
    field[node_stride * n + 3] = pressure_weight(n) * dilation;
    dilation = Real{};  // padding again
  }
  add_pressure(m, elements, field, reaction);
}

ACUS_KERNEL void react_exactly(const SystemMatrix& a, const TissueModel& m, const Corotation& corotation) {
  const double factor = a.stiffness_factor;
  react(
      m, ExactElements(m, corotation, factor),
      [&](int n) { return factor * m.node_bulk_modulus[n] / m.node_volume[n]; }, a.field.data(),
      a.reaction.data());
}

ACUS_KERNEL void react_packed(const SystemMatrix& a, const TissueModel& m) {
  react(
      m, PackedElements(a), [&](int n) { return a.pressure_weight[n]; }, a.field_single.data(),
      a.reaction_single.data());
}

ACUS_KERNEL void pack_elements(SystemMatrix& out, const TissueModel& m, const Corotation& corotation) {
  using Lane = ExactElements::Lane;
  constexpr int width = lanes_in<double, Lane>;
  ExactElements from(m, corotation, out.stiffness_factor);
  for (std::size_t first = 0; first < m.offsets.size(); first += lanes)
    for (int part = 0; part < lanes / width; ++part) {
      from.go_to(first, part);
      float* to = &out.element[first / padding * padding * element_numbers + first % padding + part * width];
      const auto pack = [&](int k, Lane value) {
        for (int l = 0; l < width; ++l) to[k * padding + l] = static_cast<float>(value[l]);
      };
      for (int k = 0; k < 9; ++k) pack(k, from.q(k));
      pack(9, from.mu_v());
      pack(10, from.lambda_v());
      pack(11, from.quarter_v());
    }
}

// y = mass x + reaction
template <class Real, class Mass>
void add_inertia(numeric::NodeVectorOf<Real>& y, const Mass& mass, const numeric::NodeVectorOf<Real>& x,
                 const numeric::NodeVectorOf<Real>& reaction) {
  Real* py = y.data();
  const Real* px = x.data();
  const Real* pr = reaction.data();
  const int nodes = static_cast<int>(x.size()) / node_stride;
  for (int i = 0; i < nodes; ++i)
    store4(py + node_stride * i, mass(i) * load4(px + node_stride * i) + load4(pr + node_stride * i));
}

}  // namespace

SystemMatrix build_system_matrix(const TissueModel& model) {
  SystemMatrix a;
  a.element.assign(model.offsets.size() * element_numbers, 0.0F);
  a.mass.assign(model.free_nodes, 0.0F);
  a.inverse_diagonal.assign(model.free_nodes, 0.0F);
  a.field.assign(static_cast<std::size_t>(model.nodes) * node_stride, 0.0);
  a.reaction = a.field;
  a.field_single.assign(a.field.size(), 0.0F);
  a.reaction_single = a.field_single;
  if (model.kind == ElementKind::nodal_pressure) a.pressure_weight.assign(model.nodes, 0.0F);
  return a;
}

void assemble_into(SystemMatrix& out, const TissueModel& model, const Corotation& corotation,
                   double mass_factor, double stiffness_factor) {
  out.mass_factor = mass_factor;
  out.stiffness_factor = stiffness_factor;
  pack_elements(out, model, corotation);
  for (int i = 0; i < model.free_nodes; ++i) {
    const double mass = mass_factor * model.node_mass[i];
    out.mass[i] = static_cast<float>(mass);
    out.inverse_diagonal[i] = static_cast<float>(1.0 / (mass + stiffness_factor * model.node_stiffness[i]));
  }
  for (std::size_t n = 0; n < out.pressure_weight.size(); ++n)
    out.pressure_weight[n] =
        static_cast<float>(stiffness_factor * model.node_bulk_modulus[n] / model.node_volume[n]);
}

void multiply_into(numeric::NodeVector& y, const TissueModel& model, const Corotation& corotation,
                   const SystemMatrix& a, const numeric::NodeVector& x) {
  std::copy(x.begin(), x.end(), a.field.begin());  // held nodes stay zero
  std::fill(a.reaction.begin(), a.reaction.end(), 0.0);
  react_exactly(a, model, corotation);
  add_inertia(
      y, [&](int i) { return a.mass_factor * model.node_mass[i]; }, x, a.reaction);
}

void multiply_into(numeric::NodeVectorOf<float>& y, const TissueModel& model, const SystemMatrix& a,
                   const numeric::NodeVectorOf<float>& x) {
  std::copy(x.begin(), x.end(), a.field_single.begin());
  std::fill(a.reaction_single.begin(), a.reaction_single.end(), 0.0F);
  react_packed(a, model);
  add_inertia(
      y, [&](int i) { return a.mass[i]; }, x, a.reaction_single);
}

}  // namespace acus::tissue
