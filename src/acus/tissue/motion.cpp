#include "acus/tissue/motion.h"

#include "acus/numeric/simd.h"

namespace acus::tissue {

using numeric::load4;
using numeric::node_stride;
using numeric::store4;

void momentum_into(numeric::NodeVector& b, const TissueModel& model, const numeric::NodeVector& velocity,
                   const numeric::NodeVector& elastic_force, double h) {
  for (int i = 0; i < model.free_nodes; ++i) {
    const std::size_t at = static_cast<std::size_t>(i) * node_stride;
    store4(&b[at], model.node_mass[i] * load4(&velocity[at]) + h * load4(&elastic_force[at]));
  }
}

void move(std::vector<Vec3>& positions, const numeric::NodeVector& velocity, double h) {
  const int free_nodes = static_cast<int>(velocity.size()) / node_stride;
  for (int i = 0; i < free_nodes; ++i) positions[i] += h * numeric::at(velocity, i);
}

double mass_product(const TissueModel& model, const numeric::NodeVector& v) {
  double total = 0.0;
  for (int i = 0; i < model.free_nodes; ++i) total += model.node_mass[i] * numeric::at(v, i).squaredNorm();
  return total;
}

}  // namespace acus::tissue
