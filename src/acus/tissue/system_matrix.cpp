#include "acus/tissue/system_matrix.h"

#include <algorithm>
#include <cstring>

#include "acus/tissue/element.h"

namespace acus::tissue {
namespace {

using numeric::load4;
using numeric::load_lanes;
using numeric::node_stride;
using numeric::Range;
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
  ACUS_INLINE Lane q(int k) const { return load_part<Lane>(batch_ + k * batch_pairs); }
  ACUS_INLINE Lane mu_v() const { return load_part<Lane>(first_); }
  ACUS_INLINE Lane lambda_v() const { return load_part<Lane>(first_ + batch_pairs); }
  ACUS_INLINE Lane quarter_v() const { return load_part<Lane>(first_ + 2 * batch_pairs); }

 private:
  const float *gradient_, *element_;
  const float *batch_ = nullptr, *first_ = nullptr;
};

// Calls `respond` for the parts of each batch of pairs with the part's own `offsets`, and adds up what it
// puts on their nodes.
template <class Elements, class Respond, class Real = typename Elements::Real>
ACUS_INLINE void add_pairs(const TissueModel& m, Range elements, const Elements& s, Real* reaction,
                           const Respond& respond) {
  using Lane = typename Elements::Lane;
  constexpr int parts = lane_count<Real> / lanes_in<Real, Lane>;
  for (std::size_t pair = elements.first / 2; pair < elements.last / 2; pair += lane_count<Real>) {
    const Offsets* offsets = m.offsets.data() + pair;
    BatchSum<Real, Lane> sum(reaction, offsets);
    for (int part = 0; part < parts; ++part) {
      Lane node[pair_nodes][4];
      respond(s, pair, part, offsets + part * lanes_in<Real, Lane>, node);
      ACUS_UNROLL
      for (int i = 0; i < pair_nodes; ++i) sum.take(part, i, node[i]);
    }
    sum.finish();
  }
}

// Adds what the elements do by themselves and, `with_dilation`, beside it V tr(G) / 4 for the nodes' means.
template <bool with_dilation, class Elements, class Real = typename Elements::Real>
ACUS_INLINE void add_local(const TissueModel& m, Range range, const Elements& elements, const Real* field,
                           Real* reaction) {
  using Lane = typename Elements::Lane;
  add_pairs(
      m, range, elements, reaction,
      [&](Elements s, std::size_t pair, int part, const Offsets* offsets, Lane(*node)[4])
          __attribute__((always_inline)) {
            Lane pair_edge[12], edge[9], q[9], g[9], stress[6], force[4][4];
            gather_edges(pair_edge, field, offsets);
            ACUS_UNROLL
            for (int side = 0; side < 2; ++side) {
              s.go_to(element_of_pair(pair, side), part);
              edges_of_side(edge, pair_edge, side);
              for (int k = 0; k < 9; ++k) q[k] = s.q(k);
              gradient_of(g, edge, q);
              const Lane trace = g[0] + g[4] + g[8];
              stress_of(stress, g, trace, s.mu_v(), s.lambda_v());
              corner_forces(force, stress, q);
              for (auto& corner : force) corner[3] = with_dilation ? s.quarter_v() * trace : Lane{};
              put_corners(node, force, side);
            }
          });
}

// Adds what the nodal pressures do: f_i += (V / 4) (sum over the corners of the pressure) q_i. A pressure
// stands beside its node's x, where one load brings both.
template <class Elements, class Real = typename Elements::Real>
ACUS_INLINE void add_pressure(const TissueModel& m, Range range, const Elements& elements, const Real* field,
                              Real* reaction) {
  using Lane = typename Elements::Lane;
  add_pairs(
      m, range, elements, reaction,
      [&](Elements s, std::size_t pair, int part, const Offsets* offsets, Lane(*node)[4])
          __attribute__((always_inline)) {
            Lane sum[2][4], q[9], force[4][4] = {};
            sum_corners(sum, field, offsets);
            ACUS_UNROLL
            for (int side = 0; side < 2; ++side) {
              s.go_to(element_of_pair(pair, side), part);
              for (int k = 0; k < 9; ++k) q[k] = s.q(k);
              corner_forces_of_pressure(force, s.quarter_v() * sum[side][3], q);
              put_corners(node, force, side);
            }
          });
}

// The same for either precision, clone by clone: what is handed to a team is not. A product reads its
// numbers from where it has them.
struct Exactly {
  const SystemMatrix& a;
  const TissueModel& m;
  const Corotation& corotation;
  numeric::NodeVector& field = a.field;
  numeric::NodeVector& reaction = a.reaction;
  double mass(std::size_t n) const { return a.mass_factor * m.node_mass[n]; }
  double pressure_weight(std::size_t n) const {
    return a.stiffness_factor * m.node_bulk_modulus[n] / m.node_volume[n];
  }
};
struct Packed {
  const SystemMatrix& a;
  const TissueModel& m;
  const Corotation& corotation;
  numeric::NodeVectorOf<float>& field = a.field_single;
  numeric::NodeVectorOf<float>& reaction = a.reaction_single;
  float mass(std::size_t n) const { return a.mass[n]; }
  float pressure_weight(std::size_t n) const { return a.pressure_weight[n]; }
};

ACUS_KERNEL void respond_alone(double* to, Range range, const Exactly& p) {
  add_local<false>(p.m, range, ExactElements(p.m, p.corotation, p.a.stiffness_factor), p.field.data(), to);
}
ACUS_KERNEL void respond_alone(float* to, Range range, const Packed& p) {
  add_local<false>(p.m, range, PackedElements(p.a, p.corotation), p.field.data(), to);
}
ACUS_KERNEL void respond_and_dilate(double* to, Range range, const Exactly& p) {
  add_local<true>(p.m, range, ExactElements(p.m, p.corotation, p.a.stiffness_factor), p.field.data(), to);
}
ACUS_KERNEL void respond_and_dilate(float* to, Range range, const Packed& p) {
  add_local<true>(p.m, range, PackedElements(p.a, p.corotation), p.field.data(), to);
}
ACUS_KERNEL void press(double* to, Range range, const Exactly& p) {
  add_pressure(p.m, range, ExactElements(p.m, p.corotation, p.a.stiffness_factor), p.field.data(), to);
}
ACUS_KERNEL void press(float* to, Range range, const Packed& p) {
  add_pressure(p.m, range, PackedElements(p.a, p.corotation), p.field.data(), to);
}

// The nodes' pressures from their dilations, which are cleared: padding again.
template <class Real, class Product>
void set_pressures(Real* sum, Range nodes, const Product& p) {
  Real* field = p.field.data();
  for (std::size_t n = nodes.first; n < nodes.last; ++n) {
    field[node_stride * n + 3] = p.pressure_weight(n) * sum[node_stride * n + 3];
    sum[node_stride * n + 3] = Real{};
  }
}

// y = mass x + sum for the free nodes of a range; clears the sum
template <class Real, class Product>
void add_inertia(Real* y, const Real* x, Real* sum, Range nodes, const Product& p) {
  const auto free = static_cast<std::size_t>(p.m.free_nodes);
  const std::size_t last = std::min(nodes.last, free);
  for (std::size_t n = nodes.first; n < last; ++n)
    store4(y + node_stride * n, p.mass(n) * load4(x + node_stride * n) + load4(sum + node_stride * n));
  std::fill(sum + node_stride * nodes.first, sum + node_stride * nodes.last, Real{});
}

template <class Real, class Product>
void multiply(numeric::NodeVectorOf<Real>& y, const numeric::NodeVectorOf<Real>& x, const Team& team,
              const Product& p) {
  const Streams& streams = p.m.streams;
  numeric::each_piece(x.size(), team, [&](Range r) {  // held nodes stay zero
    std::copy(x.begin() + r.first, x.begin() + r.last, p.field.begin() + r.first);
  });
  if (p.m.kind == ElementKind::linear) {
    streams.add(p.reaction, team, [&](Real* to, Range elements, int) { respond_alone(to, elements, p); });
  } else {
    streams.add(p.reaction, team,
                [&](Real* to, Range elements, int) { respond_and_dilate(to, elements, p); });
    streams.sum(p.reaction, team, [&](Real* sum, Range nodes, int) { set_pressures(sum, nodes, p); });
    streams.add(p.reaction, team, [&](Real* to, Range elements, int) { press(to, elements, p); });
  }
  streams.sum(p.reaction, team,
              [&](Real* sum, Range nodes, int) { add_inertia(y.data(), x.data(), sum, nodes, p); });
}

}  // namespace

SystemMatrix build_system_matrix(const TissueModel& model) {
  SystemMatrix a;
  a.element.assign(model.corners.size() * element_numbers, 0.0F);
  a.mass.assign(model.free_nodes, 0.0F);
  a.field.assign(static_cast<std::size_t>(model.nodes) * node_stride, 0.0);
  a.reaction.assign(model.streams.count() * a.field.size(), 0.0);
  a.field_single.assign(a.field.size(), 0.0F);
  a.reaction_single.assign(a.reaction.size(), 0.0F);
  if (model.kind == ElementKind::nodal_pressure) a.pressure_weight.assign(model.nodes, 0.0F);
  return a;
}

void set_factors(SystemMatrix& out, const TissueModel& model, double mass_factor, double stiffness_factor) {
  out.mass_factor = mass_factor;
  out.stiffness_factor = stiffness_factor;
  for (std::size_t e = 0; e < model.corners.size(); ++e) {
    float* to = &out.element[element_numbers * (e / batch_pairs * batch_pairs) + e % batch_pairs];
    to[0] = static_cast<float>(stiffness_factor * model.step_shear[e] * model.volume[e]);
    to[batch_pairs] = static_cast<float>(stiffness_factor * model.step_lambda[e] * model.volume[e]);
    to[2 * batch_pairs] = static_cast<float>(0.25 * model.volume[e]);
  }
  for (int i = 0; i < model.free_nodes; ++i)
    out.mass[i] = static_cast<float>(mass_factor * model.node_mass[i]);
  for (std::size_t n = 0; n < out.pressure_weight.size(); ++n)
    out.pressure_weight[n] =
        static_cast<float>(stiffness_factor * model.node_bulk_modulus[n] / model.node_volume[n]);
}

void multiply_into(numeric::NodeVector& y, const TissueModel& model, const Corotation& corotation,
                   const SystemMatrix& a, const numeric::NodeVector& x, const Team& team) {
  multiply(y, x, team, Exactly{a, model, corotation});
}

void multiply_into(numeric::NodeVectorOf<float>& y, const TissueModel& model, const Corotation& corotation,
                   const SystemMatrix& a, const numeric::NodeVectorOf<float>& x, const Team& team) {
  multiply(y, x, team, Packed{a, model, corotation});
}

}  // namespace acus::tissue
