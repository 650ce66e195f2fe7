#include "acus/tissue/corotation.h"

#include <algorithm>
#include <cmath>

#include "acus/numeric/polar.h"
#include "acus/numeric/simd.h"

namespace acus::tissue {
namespace {

using numeric::Lane4;
using numeric::Lane8;
using numeric::load4;
using numeric::node_stride;
using numeric::store4;

// Eight elements side by side. Matrices are column by column: entry (r, c) at 3 c + r.
struct Batch {
  Lane8 g[9];       // gradients g_1, g_2, g_3, 1/m
  Lane8 f[9];       // deformation gradient
  Lane8 r[9];       // rotation
  Lane8 q[12];      // R g_i, corner by corner, 1/m
  Lane8 force[12];  // N, corner by corner
  Lane8 trace;      // tr e
  Lane8 energy;     // J
};

ACUS_INLINE void gather(Batch& b, const TissueModel& m, int batch, const Vec3* x) {
  for (int i = 0; i < 9; ++i)
    std::memcpy(&b.g[i], &m.gradient[(static_cast<std::size_t>(batch) * 9 + i) * lanes], sizeof(Lane8));
  Lane8 edge[9];
  for (int l = 0; l < lanes; ++l) {
    const mesh::Tet& t = m.corners[std::min(batch * lanes + l, m.tets - 1)];
    const double* x0 = x[t[0]].data();
    for (int i = 0; i < 3; ++i) {
      const double* xi = x[t[i + 1]].data();
      for (int c = 0; c < 3; ++c) edge[3 * i + c][l] = xi[c] - x0[c];
    }
  }
  for (int d = 0; d < 3; ++d)
    for (int c = 0; c < 3; ++c)
      b.f[3 * d + c] = edge[c] * b.g[d] + edge[3 + c] * b.g[3 + d] + edge[6 + c] * b.g[6 + d];
}

ACUS_INLINE int rotate(Batch& b) {
  Lane8 first_determinant{}, change{}, determinant{}, norm_squared{};
  for (int i = 0; i < 9; ++i) {
    b.r[i] = b.f[i];
    norm_squared += b.f[i] * b.f[i];
  }
  for (int step = 0; step < numeric::newton_polar_max_steps; ++step) {
    change = numeric::newton_polar_step(b.r, determinant);
    if (step == 0) first_determinant = determinant;
    bool all = true;
    for (int l = 0; l < lanes; ++l) all = all && change[l] < numeric::newton_polar_converged;
    if (all) break;
  }
  int failures = 0;
  for (int l = 0; l < lanes; ++l) {
    if (change[l] < numeric::newton_polar_converged &&
        numeric::newton_polar_holds(first_determinant[l], norm_squared[l]))
      continue;
    Mat3 F;
    for (int i = 0; i < 9; ++i) F.data()[i] = b.f[i][l];
    const Mat3 R = F.allFinite() ? numeric::rotation_of(F) : Mat3(Mat3::Identity());
    for (int i = 0; i < 9; ++i) b.r[i][l] = R.data()[i];
    ++failures;
  }
  return failures;
}

// out_i = M v_i for three vectors side by side, and out_0 = -(sum): the corner values of a gradient field.
ACUS_INLINE void to_corners(Lane8* out, const Lane8* matrix, const Lane8* v) {
  for (int i = 0; i < 3; ++i)
    for (int c = 0; c < 3; ++c)
      out[3 * (i + 1) + c] =
          matrix[c] * v[3 * i] + matrix[3 + c] * v[3 * i + 1] + matrix[6 + c] * v[3 * i + 2];
  for (int c = 0; c < 3; ++c) out[c] = -(out[3 + c] + out[6 + c] + out[9 + c]);
}

ACUS_INLINE void respond(Batch& b, Lane8 volume, Lane8 mu, Lane8 lambda) {
  to_corners(b.q, b.r, b.g);
  Lane8 stretch[9];  // R^T F
  for (int j = 0; j < 3; ++j)
    for (int i = 0; i < 3; ++i)
      stretch[3 * j + i] =
          b.r[3 * i] * b.f[3 * j] + b.r[3 * i + 1] * b.f[3 * j + 1] + b.r[3 * i + 2] * b.f[3 * j + 2];
  const Lane8 xx = stretch[0] - 1.0, yy = stretch[4] - 1.0, zz = stretch[8] - 1.0;
  const Lane8 xy = 0.5 * (stretch[1] + stretch[3]);
  const Lane8 xz = 0.5 * (stretch[2] + stretch[6]);
  const Lane8 yz = 0.5 * (stretch[5] + stretch[7]);
  b.trace = xx + yy + zz;
  b.energy = volume * (mu * (xx * xx + yy * yy + zz * zz + 2.0 * (xy * xy + xz * xz + yz * yz)) +
                       0.5 * lambda * b.trace * b.trace);
  const Lane8 minus_two_mu_v = -2.0 * mu * volume;
  const Lane8 p = -lambda * b.trace * volume;
  const Lane8 s[9] = {minus_two_mu_v * xx + p, minus_two_mu_v * xy,     minus_two_mu_v * xz,
                      minus_two_mu_v * xy,     minus_two_mu_v * yy + p, minus_two_mu_v * yz,
                      minus_two_mu_v * xz,     minus_two_mu_v * yz,     minus_two_mu_v * zz + p};  // -V sigma
  Lane8 rotated[9];
  for (int j = 0; j < 3; ++j)
    for (int c = 0; c < 3; ++c)
      rotated[3 * j + c] = b.r[c] * s[3 * j] + b.r[3 + c] * s[3 * j + 1] + b.r[6 + c] * s[3 * j + 2];
  to_corners(b.force, rotated, b.g);
}

ACUS_INLINE void scatter(Corotation& out, const Batch& b, const TissueModel& m, int batch) {
  const int count = std::min(lanes, m.tets - batch * lanes);
  for (int l = 0; l < count; ++l) {
    const int e = batch * lanes + l;
    const mesh::Tet& t = m.corners[e];
    for (int i = 0; i < 4; ++i) {
      double* q = &out.rotated_gradient[(static_cast<std::size_t>(e) * 4 + i) * node_stride];
      double* f = &out.elastic_force[static_cast<std::size_t>(node_stride) * t[i]];
      for (int c = 0; c < 3; ++c) {
        q[c] = b.q[3 * i + c][l];
        f[c] += b.force[3 * i + c][l];
      }
    }
    out.energy += b.energy[l];
    if (!out.dilation.empty()) {
      const double share = 0.25 * m.volume[e] * b.trace[l];
      for (int node : t) out.dilation[node] += share;
    }
  }
}

ACUS_KERNEL void corotate_elements(Corotation& out, const TissueModel& m, const Vec3* x) {
  for (int batch = 0; batch < m.batches; ++batch) {
    Batch b;
    gather(b, m, batch, x);
    out.newton_failures += rotate(b);
    Lane8 volume, mu, lambda;
    const std::size_t at = static_cast<std::size_t>(batch) * lanes;
    std::memcpy(&volume, &m.volume[at], sizeof volume);
    std::memcpy(&mu, &m.shear[at], sizeof mu);
    std::memcpy(&lambda, &m.local_lambda[at], sizeof lambda);
    respond(b, volume, mu, lambda);
    scatter(out, b, m, batch);
  }
}

// Energy and force of the mean dilations: f_i -= (V / 4) (sum over the corners of kappa theta) R g_i.
ACUS_KERNEL void add_nodal_pressure(Corotation& out, const TissueModel& m) {
  for (int a = 0; a < m.nodes; ++a) {
    out.dilation[a] /= m.node_volume[a];
    out.energy += 0.5 * m.node_bulk_modulus[a] * m.node_volume[a] * out.dilation[a] * out.dilation[a];
  }
  for (int e = 0; e < m.tets; ++e) {
    const mesh::Tet& t = m.corners[e];
    double pressure = 0.0;
    for (int node : t) pressure += m.node_bulk_modulus[node] * out.dilation[node];
    const double factor = -0.25 * m.volume[e] * pressure;
    const double* q = &out.rotated_gradient[static_cast<std::size_t>(e) * 4 * node_stride];
    for (int i = 0; i < 4; ++i) {
      double* f = &out.elastic_force[static_cast<std::size_t>(node_stride) * t[i]];
      store4(f, load4(f) + factor * load4(q + node_stride * i));
    }
  }
}

}  // namespace

Corotation build_corotation(const TissueModel& model) {
  Corotation c;
  c.rotated_gradient.assign(static_cast<std::size_t>(model.tets) * 4 * node_stride, 0.0);
  c.elastic_force.assign(static_cast<std::size_t>(model.nodes) * node_stride, 0.0);
  if (model.kind == ElementKind::nodal_pressure) c.dilation.assign(model.nodes, 0.0);
  return c;
}

void corotate_into(Corotation& out, const TissueModel& model, std::span<const Vec3> positions) {
  std::fill(out.elastic_force.begin(), out.elastic_force.end(), 0.0);
  std::fill(out.dilation.begin(), out.dilation.end(), 0.0);
  out.energy = 0.0;
  out.newton_failures = 0;
  corotate_elements(out, model, positions.data());
  if (model.kind == ElementKind::nodal_pressure) add_nodal_pressure(out, model);
  out.finite = std::isfinite(out.energy);
}

}  // namespace acus::tissue
