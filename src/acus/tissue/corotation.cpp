#include "acus/tissue/corotation.h"

#include <algorithm>
#include <cmath>

#include "acus/numeric/polar.h"
#include "acus/tissue/lanes.h"

namespace acus::tissue {
namespace {

using numeric::Lane4;
using numeric::node_stride;

using Lane = ExactLane;
constexpr int width = lanes_in<double, Lane>;  // elements in a part
constexpr int parts = lanes / width;           // parts in a batch of eight elements

// Elements side by side. Matrices are column by column: entry (r, c) at 3 c + r.
struct Part {
  Lane g[9];         // gradients g_1, g_2, g_3, 1/m
  Lane f[9];         // deformation gradient
  Lane r[9];         // rotation
  Lane force[4][4];  // N, corner by corner; beside it the share V tr(e) / 4 of the nodes' mean dilations
  Lane energy;       // J
  Lane relaxed;      // J
};

// Where a part's numbers of a Maxwell branch are kept.
struct BranchPart {
  const RelaxationStep& step;
  double* spring;
  double* strain;
};

ACUS_INLINE void gather(Part& b, const double* gradient, const mesh::Tet* corners, const Vec3* x) {
  for (int k = 0; k < 9; ++k) b.g[k] = load_part<Lane>(gradient + k * lanes);
  Lane origin[4], corner[4], edge[9];
  for (int i = 0; i < 4; ++i) {
    Lane4 node[width] = {};
    for (int l = 0; l < width; ++l) node[l] = numeric::load3(x[corners[l][i]].data());
    into_lanes(i == 0 ? origin : corner, node);
    if (i > 0)
      for (int c = 0; c < 3; ++c) edge[3 * (i - 1) + c] = corner[c] - origin[c];
  }
  for (int d = 0; d < 3; ++d)
    for (int c = 0; c < 3; ++c)
      b.f[3 * d + c] = edge[c] * b.g[d] + edge[3 + c] * b.g[3 + d] + edge[6 + c] * b.g[6 + d];
}

// The rotations of a batch, by as many corrections as its slowest element needs. Returns for how many they
// failed and were made up for.
ACUS_INLINE int rotate(Part* batch) {
  Lane first_determinant[parts]{}, change[parts]{}, norm_squared[parts]{};
  for (int p = 0; p < parts; ++p)
    for (int i = 0; i < 9; ++i) {
      batch[p].r[i] = batch[p].f[i];
      norm_squared[p] += batch[p].f[i] * batch[p].f[i];
    }
  for (int step = 0; step < numeric::newton_polar_max_steps; ++step) {
    bool all = true;
    for (int p = 0; p < parts; ++p) {
      Lane determinant{};
      change[p] = numeric::newton_polar_step(batch[p].r, determinant);
      if (step == 0) first_determinant[p] = determinant;
      for (int l = 0; l < width; ++l) all = all && change[p][l] < numeric::newton_polar_converged;
    }
    if (all) break;
  }
  int failures = 0;
  for (int p = 0; p < parts; ++p)
    for (int l = 0; l < width; ++l) {
      if (change[p][l] < numeric::newton_polar_converged &&
          numeric::newton_polar_holds(first_determinant[p][l], norm_squared[p][l]))
        continue;
      Mat3 F;
      for (int i = 0; i < 9; ++i) F.data()[i] = batch[p].f[i][l];
      const Mat3 R = F.allFinite() ? numeric::rotation_of(F) : Mat3(Mat3::Identity());
      for (int i = 0; i < 9; ++i) batch[p].r[i][l] = R.data()[i];
      ++failures;
    }
  return failures;
}

// out_i = M v_i for three vectors side by side.
ACUS_INLINE void turn(Lane* out, const Lane* matrix, const Lane* v) {
  for (int i = 0; i < 3; ++i)
    for (int c = 0; c < 3; ++c)
      out[3 * i + c] = matrix[c] * v[3 * i] + matrix[3 + c] * v[3 * i + 1] + matrix[6 + c] * v[3 * i + 2];
}

// What corners 1 to 3 get, corner 0 gives.
ACUS_INLINE void give_to_corners(Lane (*force)[4], const Lane* given) {
  for (int c = 0; c < 3; ++c) {
    for (int i = 0; i < 3; ++i) force[i + 1][c] = given[3 * i + c];
    force[0][c] = -(given[c] + given[3 + c] + given[6 + c]);
  }
}

// Takes a branch to the deviator of the strain `e`; its energy and what it spends go to `b`. Returns in
// `pull` V times the stress that is left of it at the end of the next step, xx yy zz xy xz yz.
ACUS_INLINE void relax(Part& b, const BranchPart& branch, Lane* pull, const Lane* e, Lane two_mu_v) {
  const RelaxationStep& r = branch.step;
  const Lane modulus = r.modulus * two_mu_v;
  Lane stored{}, spent{};
  for (int k = 0; k < strain_numbers; ++k) {
    const double times = k < 3 ? 1.0 : 2.0;  // a shear stands twice in a tensor
    const Lane change = e[k] - load_part<Lane>(branch.strain + k * lanes);
    const Lane before = load_part<Lane>(branch.spring + k * lanes);
    const Lane mean = before + r.lead * change;
    const Lane now = r.kept * before + r.taken * change;
    stored += times * now * now;
    spent += times * (r.spent * mean * mean + r.rest * change * change);
    pull[k] = r.kept * modulus * now;
    std::memcpy(branch.spring + k * lanes, &now, sizeof now);
    std::memcpy(branch.strain + k * lanes, &e[k], sizeof e[k]);
  }
  b.energy += 0.5 * modulus * stored;
  b.relaxed = modulus * spent;
}

// Where stretch S = R^T F and stress T do not share their axes, as with a branch they need not, the rotation
// itself does work on T: the gradient of the energy is R (T + Z) with the skew Z x = z x x, (tr(S) I - S) z
// twice the axial vector of (S T - T S) / 2. Six numbers xx yy zz xy xz yz each. Bounded where the rotation
// is about to jump.
ACUS_INLINE void skew_stress(Lane* z, const Lane* s, const Lane* t) {
  const Lane twist[3] = {s[4] * t[3] - t[4] * s[3] + s[5] * (t[1] - t[2]) - t[5] * (s[1] - s[2]),
                         s[3] * t[5] - t[3] * s[5] + s[4] * (t[2] - t[0]) - t[4] * (s[2] - s[0]),
                         s[5] * t[4] - t[5] * s[4] + s[3] * (t[0] - t[1]) - t[3] * (s[0] - s[1])};
  const Lane a = s[1] + s[2], b = s[0] + s[2], c = s[0] + s[1];  // tr(S) I - S: its diagonal
  const Lane ab = -s[3], ac = -s[4], bc = -s[5];
  const Lane minor[6] = {b * c - bc * bc,  a * c - ac * ac,  a * b - ab * ab,
                         ac * bc - ab * c, ab * bc - ac * b, ab * ac - a * bc};
  const Lane determinant = a * minor[0] + ab * minor[3] + ac * minor[4];  // 8 at rest
  constexpr double least = 1e-3;
  const Lane inverse = determinant / (determinant * determinant + least * least);
  z[0] = inverse * (minor[0] * twist[0] + minor[3] * twist[1] + minor[4] * twist[2]);
  z[1] = inverse * (minor[3] * twist[0] + minor[1] * twist[1] + minor[5] * twist[2]);
  z[2] = inverse * (minor[4] * twist[0] + minor[5] * twist[1] + minor[2] * twist[2]);
}

// `branch` is a BranchPart, or nothing.
template <class... Branch>
ACUS_INLINE void respond(Part& b, double* rotated_gradient, Lane volume, Lane mu, Lane lambda,
                         const Branch&... branch) {
  Lane q[9];  // R g_i of corners 1 to 3, 1/m
  turn(q, b.r, b.g);
  for (int k = 0; k < 9; ++k) std::memcpy(rotated_gradient + k * lanes, &q[k], sizeof q[k]);
  Lane stretch[9];  // R^T F
  for (int j = 0; j < 3; ++j)
    for (int i = 0; i < 3; ++i)
      stretch[3 * j + i] =
          b.r[3 * i] * b.f[3 * j] + b.r[3 * i + 1] * b.f[3 * j + 1] + b.r[3 * i + 2] * b.f[3 * j + 2];
  const Lane xx = stretch[0] - 1.0, yy = stretch[4] - 1.0, zz = stretch[8] - 1.0;
  const Lane xy = 0.5 * (stretch[1] + stretch[3]);
  const Lane xz = 0.5 * (stretch[2] + stretch[6]);
  const Lane yz = 0.5 * (stretch[5] + stretch[7]);
  const Lane trace = xx + yy + zz;
  b.energy = volume * (mu * (xx * xx + yy * yy + zz * zz + 2.0 * (xy * xy + xz * xz + yz * yz)) +
                       0.5 * lambda * trace * trace);
  const Lane minus_two_mu_v = -2.0 * mu * volume;
  const Lane p = -lambda * trace * volume;
  Lane s[9] = {minus_two_mu_v * xx + p, minus_two_mu_v * xy,     minus_two_mu_v * xz,
               minus_two_mu_v * xy,     minus_two_mu_v * yy + p, minus_two_mu_v * yz,
               minus_two_mu_v * xz,     minus_two_mu_v * yz,     minus_two_mu_v * zz + p};  // -V sigma
  if constexpr (sizeof...(branch) > 0) {
    const Lane third = trace / 3.0;
    const Lane deviator[strain_numbers] = {xx - third, yy - third, zz - third, xy, xz, yz};
    Lane pull[strain_numbers];
    relax(b, branch..., pull, deviator, 2.0 * mu * volume);
    constexpr int place[9] = {0, 3, 4, 3, 1, 5, 4, 5, 2};
    for (int k = 0; k < 9; ++k) s[k] -= pull[place[k]];
    const Lane stretched[strain_numbers] = {xx + 1.0, yy + 1.0, zz + 1.0, xy, xz, yz};
    Lane z[3];
    skew_stress(z, stretched, pull);
    s[5] -= z[0], s[7] += z[0];
    s[6] -= z[1], s[2] += z[1];
    s[1] -= z[2], s[3] += z[2];
  }
  Lane rotated[9], given[9];
  turn(rotated, b.r, s);
  turn(given, rotated, b.g);
  give_to_corners(b.force, given);
  for (auto& force : b.force) force[3] = 0.25 * volume * trace;
}

// `branch` is a MaxwellBranch, or nothing.
template <class... Branch>
ACUS_INLINE void each_element(Corotation& out, const TissueModel& m, const Vec3* x, Branch&... branch) {
  for (std::size_t first = 0; first < m.corners.size(); first += lanes) {
    Part batch[parts];
    for (int p = 0; p < parts; ++p)
      gather(batch[p], &m.gradient[9 * first + p * width], m.corners.data() + first + p * width, x);
    out.newton_failures += rotate(batch);
    BatchSum<double, Lane> sum(out.elastic_force.data(), m.offsets.data() + first);
    for (int p = 0; p < parts; ++p) {
      const std::size_t at = first + p * width;
      [[maybe_unused]] const std::size_t of_branch = strain_numbers * first + p * width;
      respond(batch[p], &out.rotated_gradient[9 * first + p * width], load_part<Lane>(&m.volume[at]),
              load_part<Lane>(&m.shear[at]), load_part<Lane>(&m.local_lambda[at]),
              BranchPart{m.relaxation, &branch.spring[of_branch], &branch.strain[of_branch]}...);
      for (int i = 0; i < 4; ++i) sum.take(p, i, batch[p].force[i]);
      for (int l = 0; l < width; ++l) out.energy += batch[p].energy[l];
      if constexpr (sizeof...(branch) > 0)
        for (int l = 0; l < width; ++l) out.relaxed += batch[p].relaxed[l];
    }
    sum.finish();
  }
}

ACUS_KERNEL void corotate_elements(Corotation& out, const TissueModel& m, const Vec3* x) {
  each_element(out, m, x);
}

ACUS_KERNEL void corotate_and_relax_elements(Corotation& out, MaxwellBranch& branch, const TissueModel& m,
                                             const Vec3* x) {
  each_element(out, m, x, branch);
}

// Energy and force of the mean dilations: f_i -= (V / 4) (sum over the corners of kappa theta) R g_i.
ACUS_KERNEL void add_nodal_pressure(Corotation& out, const TissueModel& m) {
  for (int a = 0; a < m.nodes; ++a) {
    out.dilation[a] = out.elastic_force[static_cast<std::size_t>(node_stride) * a + 3] / m.node_volume[a];
    out.energy += 0.5 * m.node_bulk_modulus[a] * m.node_volume[a] * out.dilation[a] * out.dilation[a];
  }
  for (std::size_t first = 0; first < m.corners.size(); first += lanes) {
    BatchSum<double, Lane> sum(out.elastic_force.data(), m.offsets.data() + first);
    for (int p = 0; p < parts; ++p) {
      const std::size_t at = first + p * width;
      Lane pressure{}, given[9], force[4][4] = {};
      for (int l = 0; l < width; ++l)
        for (int node : m.corners[at + l]) pressure[l] += m.node_bulk_modulus[node] * out.dilation[node];
      const Lane factor = -0.25 * load_part<Lane>(&m.volume[at]) * pressure;
      for (int k = 0; k < 9; ++k)
        given[k] = factor * load_part<Lane>(&out.rotated_gradient[9 * first + p * width + k * lanes]);
      give_to_corners(force, given);
      for (int i = 0; i < 4; ++i) sum.take(p, i, force[i]);
    }
    sum.finish();
  }
}

void clear(Corotation& out) {
  std::fill(out.elastic_force.begin(), out.elastic_force.end(), 0.0);
  std::fill(out.dilation.begin(), out.dilation.end(), 0.0);
  out.energy = out.relaxed = 0.0;
  out.newton_failures = 0;
}

void finish(Corotation& out, const TissueModel& model) {
  if (model.kind == ElementKind::nodal_pressure) add_nodal_pressure(out, model);
  for (std::size_t i = 3; i < out.elastic_force.size(); i += node_stride) out.elastic_force[i] = 0.0;
  out.finite = std::isfinite(out.energy);
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
  clear(out);
  corotate_elements(out, model, positions.data());
  finish(out, model);
}

void corotate_into(Corotation& out, MaxwellBranch& branch, const TissueModel& model,
                   std::span<const Vec3> positions) {
  if (!model.relaxation.relaxes()) return corotate_into(out, model, positions);
  clear(out);
  corotate_and_relax_elements(out, branch, model, positions.data());
  finish(out, model);
}

}  // namespace acus::tissue
