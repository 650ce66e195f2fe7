#include "acus/needle/rod_motion.h"

namespace acus::needle {
namespace {

void weigh(RodMotion& m, const Rod& rod, const RodState& s, double h) {
  for (int i = 0; i < rod.unknowns(); ++i)
    m.residual[i] = inertia(rod, i) * (m.rate_before[i] - s.rate[i]) + h * m.force[i];
}

}  // namespace

RodMotion build_rod_motion(const Rod& rod) {
  RodMotion m;
  m.matrix = RodMatrix(rod.unknowns());
  for (auto* v : {&m.rate_before, &m.force, &m.residual, &m.change}) v->assign(rod.unknowns(), 0.0);
  return m;
}

double inertia(const Rod& rod, int unknown) {
  return is_spin(unknown) ? rod.edge_inertia[unknown / 4] : rod.node_mass[unknown / 4];
}

double inertia_product(const Rod& rod, const std::vector<double>& rate) {
  double sum = 0.0;
  for (int i = 0; i < rod.unknowns(); ++i) sum += inertia(rod, i) * rate[i] * rate[i];
  return sum;
}

void begin_step(RodMotion& m, const Rod& rod, RodState& s, const Pose& hub, double h) {
  m.rate_before = s.rate;
  const Vec3 hub_rate = (hub.position - s.position[0]) / h;
  const Vec3 jump = hub_rate - Vec3(s.rate[0], s.rate[1], s.rate[2]);
  for (int i = 0; i < rod.nodes(); ++i)
    for (int k = 0; k < 3; ++k) s.rate[place_at(i) + k] += jump[k];
  for (int i = 0; i < rod.unknowns(); ++i) m.change[i] = h * s.rate[i];
  displace(s, rod, m.change);
}

void load(RodMotion& m, const Rod& rod, const RodState& s, const Pose& hub, const Pose& tip, double h) {
  m.energy = rod_forces_into(m.force, rod, s, hub, tip);
  weigh(m, rod, s, h);
}

void linearise(RodMotion& m, const Rod& rod, const RodState& s, const Pose& hub, const Pose& tip, double h,
               double compression) {
  m.matrix.clear();
  m.energy = rod_forces_into(m.force, m.matrix, h * h, compression, rod, s, hub, tip);
  for (int i = 0; i < rod.unknowns(); ++i) m.matrix.add(i, i, inertia(rod, i));
  weigh(m, rod, s, h);
}

void hold_hub(RodMotion& m) {
  constexpr double heavy = 1e20;  // kg: nothing moves it
  for (int k = 0; k < 3; ++k) m.matrix.add(k, k, heavy);
}

void apply_change(RodMotion& m, const Rod& rod, RodState& s, double h) {
  for (int i = 0; i < rod.unknowns(); ++i) {
    s.rate[i] += m.change[i];
    m.change[i] *= h;
  }
  displace(s, rod, m.change);
}

}  // namespace acus::needle
