#include "acus/tissue/system_matrix.h"

#include <algorithm>
#include <cassert>

#include "acus/tissue/pair_sums.h"
#include "acus/tissue/pressure.h"

namespace acus::tissue {
namespace {

using numeric::load4;
using numeric::node_stride;
using numeric::Range;
using numeric::store4;

// V mu and V lambda with the factor, of elements side by side: straight from where they are kept,
template <class Lane>
class ExactModuli {
 public:
  ACUS_INLINE ExactModuli(const SystemMatrix& a, const TissueModel& m)
      : volume_(m.volume, 1),
        shear_(m.step_shear, 1),
        lambda_(m.step_lambda, 1),
        factor_(a.stiffness_factor) {}
  ACUS_INLINE Lane mu_v(std::size_t first, int part) const {
    return factor_ * shear_.of(first, part)[0] * volume_.of(first, part)[0];
  }
  ACUS_INLINE Lane lambda_v(std::size_t first, int part) const {
    return factor_ * lambda_.of(first, part)[0] * volume_.of(first, part)[0];
  }

 private:
  ElementNumbers<Lane> volume_, shear_, lambda_;
  double factor_;
};
// or made ready.
template <class Lane>
class SingleModuli {
 public:
  ACUS_INLINE SingleModuli(const SystemMatrix& a, const TissueModel&) : moduli_(a.moduli, element_moduli) {}
  ACUS_INLINE Lane mu_v(std::size_t first, int part) const { return moduli_.of(first, part)[0]; }
  ACUS_INLINE Lane lambda_v(std::size_t first, int part) const { return moduli_.of(first, part)[1]; }

 private:
  ElementNumbers<Lane> moduli_;
};

// The same for either precision. A product reads its numbers from where it has them.
struct Exactly {
  template <class Lane>
  using Moduli = ExactModuli<Lane>;
  const SystemMatrix& a;
  const TissueModel& m;
  const Corotation& corotation;
  numeric::NodeVector& field = a.field;
  numeric::NodeVector& reaction = a.reaction;
  const std::vector<double>& gradient = corotation.exact.gradient;
  const std::vector<double>& quarter_volume = m.exact.quarter_volume;
  double mass(std::size_t n) const { return a.mass_factor * m.node_mass[n]; }
  double pressure_weight(std::size_t n) const {
    return a.stiffness_factor * m.node_bulk_modulus[n] / m.node_volume[n];
  }
};
struct Singly {
  template <class Lane>
  using Moduli = SingleModuli<Lane>;
  const SystemMatrix& a;
  const TissueModel& m;
  const Corotation& corotation;
  numeric::NodeVectorOf<float>& field = a.field_single;
  numeric::NodeVectorOf<float>& reaction = a.reaction_single;
  const std::vector<float>& gradient = corotation.single.gradient;
  const std::vector<float>& quarter_volume = m.single.quarter_volume;
  float mass(std::size_t n) const { return a.mass[n]; }
  float pressure_weight(std::size_t n) const { return a.pressure_weight[n]; }
};

// Adds what the elements do by themselves and beside it V tr(G) / 4 for the nodes' means.
template <class Lane, class Real, class Product>
ACUS_INLINE void add_local(Real* to, Range elements, const Product& p) {
  const ElementNumbers<Lane> gradients(p.gradient, 9), quarters(p.quarter_volume, 1);
  const typename Product::template Moduli<Lane> moduli(p.a, p.m);
  add_pairs<Lane>(to, p.m, elements,
                  [&](std::size_t pair, int part, const Offsets* offsets, Lane(*node)[4]) ACUS_INLINED {
                    Lane pair_edge[12], edge[9], q[9], g[9], stress[6], force[4][4];
                    gather_edges(pair_edge, p.field.data(), offsets);
                    ACUS_UNROLL
                    for (int side = 0; side < 2; ++side) {
                      const std::size_t first = element_of_pair(pair, side);
                      const auto of_side = gradients.of(first, part);
                      edges_of_side(edge, pair_edge, side);
                      for (int k = 0; k < 9; ++k) q[k] = of_side[k];
                      gradient_of(g, edge, q);
                      const Lane trace = g[0] + g[4] + g[8];
                      stress_of(stress, g, trace, moduli.mu_v(first, part), moduli.lambda_v(first, part));
                      corner_forces(force, stress, q);
                      for (auto& corner : force) corner[3] = quarters.of(first, part)[0] * trace;
                      put_corners(node, force, side);
                    }
                  });
}

template <class Real, class Product>
void respond(Real* to, Range elements, const Product& p) {
  numeric::run_kernel([&](auto bytes)
                          ACUS_INLINED { add_local<numeric::LaneOf<Real, bytes>>(to, elements, p); });
}

// The nodes' pressures from their dilations, which are cleared: a sum's fourth number is zero otherwise.
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
  streams.add(p.reaction, team, [&](Real* to, Range elements, int) { respond(to, elements, p); });
  if (p.m.kind == ElementKind::nodal_pressure) {
    streams.sum(p.reaction, team, [&](Real* sum, Range nodes, int) { set_pressures(sum, nodes, p); });
    streams.add(p.reaction, team,
                [&](Real* to, Range elements, int) { press(to, p.m, elements, p.gradient, p.field); });
  }
  streams.sum(p.reaction, team,
              [&](Real* sum, Range nodes, int) { add_inertia(y.data(), x.data(), sum, nodes, p); });
}

}  // namespace

SystemMatrix build_system_matrix(const TissueModel& model) {
  SystemMatrix a;
  a.moduli.assign(model.corners.size() * element_moduli, 0.0F);
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
    const double v = stiffness_factor * model.volume[e];
    out.moduli[place_of<float>(e, 0, element_moduli)] = static_cast<float>(v * model.step_shear[e]);
    out.moduli[place_of<float>(e, 1, element_moduli)] = static_cast<float>(v * model.step_lambda[e]);
  }
  for (int i = 0; i < model.free_nodes; ++i)
    out.mass[i] = static_cast<float>(mass_factor * model.node_mass[i]);
  for (std::size_t n = 0; n < out.pressure_weight.size(); ++n)
    out.pressure_weight[n] =
        static_cast<float>(stiffness_factor * model.node_bulk_modulus[n] / model.node_volume[n]);
}

void multiply_into(numeric::NodeVector& y, const TissueModel& model, const Corotation& corotation,
                   const SystemMatrix& a, const numeric::NodeVector& x, const Team& team) {
  assert(!corotation.is_single());
  multiply(y, x, team, Exactly{a, model, corotation});
}

void multiply_into(numeric::NodeVectorOf<float>& y, const TissueModel& model, const Corotation& corotation,
                   const SystemMatrix& a, const numeric::NodeVectorOf<float>& x, const Team& team) {
  multiply(y, x, team, Singly{a, model, corotation});
}

}  // namespace acus::tissue
