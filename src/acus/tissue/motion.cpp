#include "acus/tissue/motion.h"

#include "acus/numeric/pieces.h"
#include "acus/numeric/simd.h"

namespace acus::tissue {

using numeric::load4;
using numeric::node_stride;
using numeric::Range;
using numeric::store4;

void momentum_into(numeric::NodeVector& b, const TissueModel& model, const numeric::NodeVector& velocity,
                   const numeric::NodeVector& elastic_force, double h, const Team& team) {
  numeric::each_piece(b.size(), team, [&](Range r) {
    for (std::size_t at = r.first; at < r.last; at += node_stride)
      store4(&b[at],
             model.node_mass[at / node_stride] * load4(&velocity[at]) + h * load4(&elastic_force[at]));
  });
}

void move(std::vector<Vec3>& positions, const numeric::NodeVector& velocity, double h, const Team& team) {
  numeric::each_piece(velocity.size(), team, [&](Range r) {
    for (std::size_t at = r.first; at < r.last; at += node_stride)
      positions[at / node_stride] += h * Vec3::Map(&velocity[at]);
  });
}

double mass_product(const TissueModel& model, const numeric::NodeVector& v, const Team& team) {
  return numeric::sum_of_pieces(v.size(), team, [&](Range r) {
    double total = 0.0;
    for (std::size_t at = r.first; at < r.last; at += node_stride)
      total += model.node_mass[at / node_stride] * Vec3::Map(&v[at]).squaredNorm();
    return total;
  });
}

}  // namespace acus::tissue
