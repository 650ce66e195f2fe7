#include "acus/tissue/corotation.h"

#include <algorithm>
#include <cmath>

#include "acus/numeric/polar.h"
#include "acus/tissue/lanes.h"

namespace acus::tissue {
namespace {

using numeric::Lane4;
using numeric::Lane8;
using numeric::load_lanes;
using numeric::node_stride;

// Eight elements side by side. Matrices are column by column: entry (r, c) at 3 c + r.
struct Batch {
  Lane8 g[9];         // gradients g_1, g_2, g_3, 1/m
  Lane8 f[9];         // deformation gradient
  Lane8 r[9];         // rotation
  Lane8 q[9];         // R g_i of corners 1 to 3, 1/m
  Lane8 force[4][4];  // N, corner by corner; beside it the share V tr(e) / 4 of the nodes' mean dilations
  Lane8 energy;       // J
};

ACUS_INLINE void gather(Batch& b, const TissueModel& m, std::size_t first, const Vec3* x) {
  std::memcpy(b.g, &m.gradient[9 * first], sizeof b.g);
  const mesh::Tet* corners = m.corners.data() + first;
  Lane8 origin[4], corner[4], edge[9];
  for (int i = 0; i < 4; ++i) {
    Lane4 node[lanes] = {};
    for (int l = 0; l < lanes; ++l) node[l] = numeric::load3(x[corners[l][i]].data());
    into_lanes(i == 0 ? origin : corner, node);
    if (i > 0)
      for (int c = 0; c < 3; ++c) edge[3 * (i - 1) + c] = corner[c] - origin[c];
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

// out_i = M v_i for three vectors side by side.
ACUS_INLINE void turn(Lane8* out, const Lane8* matrix, const Lane8* v) {
  for (int i = 0; i < 3; ++i)
    for (int c = 0; c < 3; ++c)
      out[3 * i + c] = matrix[c] * v[3 * i] + matrix[3 + c] * v[3 * i + 1] + matrix[6 + c] * v[3 * i + 2];
}

// What corners 1 to 3 get, corner 0 gives.
ACUS_INLINE void give_to_corners(Lane8 (*force)[4], const Lane8* given) {
  for (int c = 0; c < 3; ++c) {
    for (int i = 0; i < 3; ++i) force[i + 1][c] = given[3 * i + c];
    force[0][c] = -(given[c] + given[3 + c] + given[6 + c]);
  }
}

ACUS_INLINE void respond(Batch& b, Lane8 volume, Lane8 mu, Lane8 lambda) {
  turn(b.q, b.r, b.g);
  Lane8 stretch[9];  // R^T F
  for (int j = 0; j < 3; ++j)
    for (int i = 0; i < 3; ++i)
      stretch[3 * j + i] =
          b.r[3 * i] * b.f[3 * j] + b.r[3 * i + 1] * b.f[3 * j + 1] + b.r[3 * i + 2] * b.f[3 * j + 2];
  const Lane8 xx = stretch[0] - 1.0, yy = stretch[4] - 1.0, zz = stretch[8] - 1.0;
  const Lane8 xy = 0.5 * (stretch[1] + stretch[3]);
  const Lane8 xz = 0.5 * (stretch[2] + stretch[6]);
  const Lane8 yz = 0.5 * (stretch[5] + stretch[7]);
  const Lane8 trace = xx + yy + zz;
  b.energy = volume * (mu * (xx * xx + yy * yy + zz * zz + 2.0 * (xy * xy + xz * xz + yz * yz)) +
                       0.5 * lambda * trace * trace);
  const Lane8 minus_two_mu_v = -2.0 * mu * volume;
  const Lane8 p = -lambda * trace * volume;
  const Lane8 s[9] = {minus_two_mu_v * xx + p, minus_two_mu_v * xy,     minus_two_mu_v * xz,
                      minus_two_mu_v * xy,     minus_two_mu_v * yy + p, minus_two_mu_v * yz,
                      minus_two_mu_v * xz,     minus_two_mu_v * yz,     minus_two_mu_v * zz + p};  // -V sigma
  Lane8 rotated[9], given[9];
  turn(rotated, b.r, s);
  turn(given, rotated, b.g);
  give_to_corners(b.force, given);
  for (auto& force : b.force) force[3] = 0.25 * volume * trace;
}

ACUS_KERNEL void corotate_elements(Corotation& out, const TissueModel& m, const Vec3* x) {
  for (std::size_t first = 0; first < m.corners.size(); first += lanes) {
    Batch b;
    gather(b, m, first, x);
    out.newton_failures += rotate(b);
    respond(b, load_lanes(&m.volume[first]), load_lanes(&m.shear[first]), load_lanes(&m.local_lambda[first]));
    std::memcpy(&out.rotated_gradient[9 * first], b.q, sizeof b.q);
    for (int i = 0; i < 4; ++i) add_corner(out.elastic_force.data(), m.offsets.data() + first, i, b.force[i]);
    for (int l = 0; l < lanes; ++l) out.energy += b.energy[l];
  }
}

// Energy and force of the mean dilations: f_i -= (V / 4) (sum over the corners of kappa theta) R g_i.
ACUS_KERNEL void add_nodal_pressure(Corotation& out, const TissueModel& m) {
  for (int a = 0; a < m.nodes; ++a) {
    out.dilation[a] = out.elastic_force[static_cast<std::size_t>(node_stride) * a + 3] / m.node_volume[a];
    out.energy += 0.5 * m.node_bulk_modulus[a] * m.node_volume[a] * out.dilation[a] * out.dilation[a];
  }
  for (std::size_t first = 0; first < m.corners.size(); first += lanes) {
    Lane8 sum{}, given[9], force[4][4] = {};
    for (int l = 0; l < lanes; ++l)
      for (int node : m.corners[first + l]) sum[l] += m.node_bulk_modulus[node] * out.dilation[node];
    const Lane8 factor = -0.25 * load_lanes(&m.volume[first]) * sum;
    for (int k = 0; k < 9; ++k) given[k] = factor * load_lanes(&out.rotated_gradient[9 * first + k * lanes]);
    give_to_corners(force, given);
    for (int i = 0; i < 4; ++i) add_corner(out.elastic_force.data(), m.offsets.data() + first, i, force[i]);
  }
}

}  // namespace

Corotation build_corotation(const TissueModel& model) {
  Corotation c;
  c.rotated_gradient.assign(9 * model.corners.size(), 0.0);
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
  for (std::size_t i = 3; i < out.elastic_force.size(); i += node_stride) out.elastic_force[i] = 0.0;
  out.finite = std::isfinite(out.energy);
}

}  // namespace acus::tissue
