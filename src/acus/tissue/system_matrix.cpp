#include "acus/tissue/system_matrix.h"

#include <algorithm>

#include "acus/numeric/simd.h"

namespace acus::tissue {
namespace {

using numeric::block_stride;
using numeric::Lane4;
using numeric::load4;
using numeric::node_stride;
using numeric::store4;

// Block (i, j) of V (lambda q_i q_j^T + mu q_j q_i^T + mu (q_i . q_j) I), added column by column.
ACUS_INLINE void add_block(double* block, Lane4 qi, Lane4 qj, double lambda_v, double mu_v) {
  const Lane4 a = lambda_v * qi;
  const Lane4 b = mu_v * qj;
  const double diagonal = mu_v * (qi[0] * qj[0] + qi[1] * qj[1] + qi[2] * qj[2]);
  for (int c = 0; c < 3; ++c) {
    Lane4 column = a * qj[c] + b * qi[c];
    column[c] += diagonal;
    store4(block + 4 * c, load4(block + 4 * c) + column);
  }
}

ACUS_KERNEL void assemble_blocks(SystemMatrix& out, const TissueModel& m, const Corotation& corotation,
                                 double factor) {
  for (int e = 0; e < m.tets; ++e) {
    const double* q = &corotation.rotated_gradient[static_cast<std::size_t>(e) * 4 * node_stride];
    const Lane4 corner[4] = {load4(q), load4(q + 4), load4(q + 8), load4(q + 12)};
    const double mu_v = factor * m.shear[e] * m.volume[e];
    const double lambda_v = factor * m.local_lambda[e] * m.volume[e];
    const auto& slot = m.slot[e];
    for (int i = 0; i < 4; ++i) {
      if (m.corners[e][i] >= m.free_nodes) continue;
      for (int j = 0; j < 4; ++j)
        if (const int s = slot[4 * i + j]; s >= 0)
          add_block(&out.block[static_cast<std::size_t>(s) * block_stride], corner[i], corner[j], lambda_v,
                    mu_v);
    }
  }
}

ACUS_KERNEL void assemble_divergence(SystemMatrix& out, const TissueModel& m, const Corotation& corotation) {
  for (int e = 0; e < m.tets; ++e) {
    const double* q = &corotation.rotated_gradient[static_cast<std::size_t>(e) * 4 * node_stride];
    for (int i = 0; i < 4; ++i) {
      const double share = 0.25 * m.volume[e] / m.node_volume[m.corners[e][i]];
      for (int j = 0; j < 4; ++j) {
        const int s = m.slot[e][4 * i + j];
        if (s < 0) continue;
        double* b = &out.divergence[static_cast<std::size_t>(s) * node_stride];
        store4(b, load4(b) + share * load4(q + node_stride * j));
      }
    }
  }
}

// The diagonal blocks of sum_a w_a b_a b_a^T.
ACUS_KERNEL void add_pressure_diagonal(SystemMatrix& out, const TissueModel& m) {
  for (int a = 0; a < m.nodes; ++a)
    for (int s = m.pattern.row_start[a]; s < m.pattern.row_start[a + 1]; ++s) {
      const Lane4 b = load4(&out.divergence[static_cast<std::size_t>(s) * node_stride]);
      double* d = &out.inverse_diagonal[static_cast<std::size_t>(m.pattern.column[s]) * block_stride];
      for (int c = 0; c < 3; ++c) store4(d + 4 * c, load4(d + 4 * c) + out.pressure_weight[a] * b[c] * b);
    }
}

}  // namespace

SystemMatrix build_system_matrix(const TissueModel& model) {
  SystemMatrix a;
  a.block.assign(static_cast<std::size_t>(model.pattern.row_start[model.free_nodes]) * block_stride, 0.0);
  a.inverse_diagonal.assign(static_cast<std::size_t>(model.free_nodes) * block_stride, 0.0);
  if (model.kind == ElementKind::nodal_pressure) {
    a.divergence.assign(static_cast<std::size_t>(model.pattern.entries()) * node_stride, 0.0);
    a.pressure_weight.assign(model.nodes, 0.0);
  }
  return a;
}

bool assemble_into(SystemMatrix& out, const TissueModel& model, const Corotation& corotation,
                   double mass_factor, double stiffness_factor) {
  std::fill(out.block.begin(), out.block.end(), 0.0);
  assemble_blocks(out, model, corotation, stiffness_factor);
  for (int i = 0; i < model.free_nodes; ++i) {
    double* d = &out.block[static_cast<std::size_t>(model.pattern.diagonal[i]) * block_stride];
    for (int c = 0; c < 3; ++c) d[4 * c + c] += mass_factor * model.node_mass[i];
    std::copy(d, d + block_stride, &out.inverse_diagonal[static_cast<std::size_t>(i) * block_stride]);
  }
  if (model.kind == ElementKind::nodal_pressure) {
    std::fill(out.divergence.begin(), out.divergence.end(), 0.0);
    assemble_divergence(out, model, corotation);
    for (int a = 0; a < model.nodes; ++a)
      out.pressure_weight[a] = stiffness_factor * model.node_bulk_modulus[a] * model.node_volume[a];
    add_pressure_diagonal(out, model);
  }
  return numeric::invert_blocks(out.inverse_diagonal);
}

void multiply_into(numeric::NodeVector& y, const TissueModel& model, const SystemMatrix& a,
                   const numeric::NodeVector& x) {
  numeric::multiply_into(y, model.pattern, a.block, x);
  if (!a.divergence.empty())
    numeric::add_gram_product_into(y, model.pattern, a.divergence, a.pressure_weight, x);
}

}  // namespace acus::tissue
