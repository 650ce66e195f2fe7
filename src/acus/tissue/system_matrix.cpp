#include "acus/tissue/system_matrix.h"

#include <algorithm>
#include <cstring>

#include "acus/tissue/element.h"

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
  ACUS_INLINE PackedElements(const SystemMatrix& a, const Corotation& corotation)
      : gradient_(corotation.single_gradient.data()), element_(a.element.data()) {}
  ACUS_INLINE void go_to(std::size_t first, int part) {
    const int skipped = part * lanes_in<Real, Lane>;
    batch_ = gradient_ + 9 * first + skipped;
    first_ = element_ + element_numbers * first + skipped;
  }
  ACUS_INLINE Lane q(int k) const { return load_part<Lane>(batch_ + k * padding); }
  ACUS_INLINE Lane mu_v() const { return load_part<Lane>(first_); }
  ACUS_INLINE Lane lambda_v() const { return load_part<Lane>(first_ + padding); }
  ACUS_INLINE Lane quarter_v() const { return load_part<Lane>(first_ + 2 * padding); }

 private:
  const float *gradient_, *element_;
  const float *batch_ = nullptr, *first_ = nullptr;
};

// Calls `respond` for the parts of each batch of elements with the part's own `offsets`, and adds up what it
// puts.
template <class Elements, class Respond, class Real = typename Elements::Real>
ACUS_INLINE void add_elements(const TissueModel& m, Elements s, Real* reaction, const Respond& respond) {
  using Lane = typename Elements::Lane;
  constexpr int parts = lane_count<Real> / lanes_in<Real, Lane>;
  for (std::size_t first = 0; first < m.offsets.size(); first += lane_count<Real>) {
    const Offsets* offsets = m.offsets.data() + first;
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
      [&](const Elements& s, const Offsets* offsets, const auto& put) __attribute__((always_inline)) {
        Lane edge[9], q[9], g[9], stress[6], force[4][4];
        gather_edges(edge, field, offsets);
        for (int k = 0; k < 9; ++k) q[k] = s.q(k);
        gradient_of(g, edge, q);
        const Lane trace = g[0] + g[4] + g[8];
        stress_of(stress, g, trace, s.mu_v(), s.lambda_v());
        corner_forces(force, stress, q);
        ACUS_UNROLL
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
      [&](const Elements& s, const Offsets* offsets, const auto& put) __attribute__((always_inline)) {
        Lane sum[4], q[9], force[4][4];
        sum_corners(sum, field, offsets);
        for (int k = 0; k < 9; ++k) q[k] = s.q(k);
        corner_forces_of_pressure(force, s.quarter_v() * sum[3], q);
        ACUS_UNROLL
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

ACUS_KERNEL void react_packed(const SystemMatrix& a, const TissueModel& m, const Corotation& corotation) {
  react(
      m, PackedElements(a, corotation), [&](int n) { return a.pressure_weight[n]; }, a.field_single.data(),
      a.reaction_single.data());
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
  a.inverse_block.assign(3 * static_cast<std::size_t>(node_stride) * model.free_nodes, 0.0F);
  a.field.assign(static_cast<std::size_t>(model.nodes) * node_stride, 0.0);
  a.reaction = a.field;
  a.field_single.assign(a.field.size(), 0.0F);
  a.reaction_single = a.field_single;
  if (model.kind == ElementKind::nodal_pressure) a.pressure_weight.assign(model.nodes, 0.0F);
  return a;
}

void set_factors(SystemMatrix& out, const TissueModel& model, double mass_factor, double stiffness_factor) {
  out.mass_factor = mass_factor;
  out.stiffness_factor = stiffness_factor;
  for (std::size_t e = 0; e < model.offsets.size(); ++e) {
    float* to = &out.element[element_numbers * (e / padding * padding) + e % padding];
    to[0] = static_cast<float>(stiffness_factor * model.step_shear[e] * model.volume[e]);
    to[padding] = static_cast<float>(stiffness_factor * model.step_lambda[e] * model.volume[e]);
    to[2 * padding] = static_cast<float>(0.25 * model.volume[e]);
  }
  for (int i = 0; i < model.free_nodes; ++i) {
    const double mass = mass_factor * model.node_mass[i];
    out.mass[i] = static_cast<float>(mass);
    const Mat3 inverse = (mass * Mat3::Identity() + stiffness_factor * model.node_stiffness[i]).inverse();
    for (int c = 0; c < 3; ++c) numeric::at(out.inverse_block, 3 * i + c) = inverse.col(c).cast<float>();
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

void multiply_into(numeric::NodeVectorOf<float>& y, const TissueModel& model, const Corotation& corotation,
                   const SystemMatrix& a, const numeric::NodeVectorOf<float>& x) {
  std::copy(x.begin(), x.end(), a.field_single.begin());
  std::fill(a.reaction_single.begin(), a.reaction_single.end(), 0.0F);
  react_packed(a, model, corotation);
  add_inertia(
      y, [&](int i) { return a.mass[i]; }, x, a.reaction_single);
}

}  // namespace acus::tissue
