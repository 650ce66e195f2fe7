#include "acus/tissue/corotation.h"

#include <array>
#include <cmath>

#include "acus/numeric/polar.h"
#include "acus/tissue/pressure.h"
#include "acus/tissue/tracked_rotation.h"

namespace acus::tissue {
namespace {

using numeric::node_stride;
using numeric::Range;

using Lane = ExactLane;
constexpr int width = lanes_in<double, Lane>;  // elements in a part
constexpr int parts = lanes / width;           // parts in a batch of eight elements

// Elements side by side. Matrices are column by column: entry (r, c) at 3 c + r.
struct Part {
  Lane edge[9];  // x_i - x_0 of corners 1 to 3, m
  Lane q[9];     // rotated gradients, 1/m
  Lane stress[stress_numbers_with_skew];
};

// What a kernel sums up over the elements of a stream, lane by lane.
struct Sums {
  Lane energy[parts]{}, relaxed[parts]{};
  int safe_rotations = 0;
};

ACUS_INLINE void store_part(double* to, const Lane& v) { std::memcpy(to, &v, sizeof v); }
ACUS_INLINE void store_part(float* to, const Lane& v) {
  for (int l = 0; l < width; ++l) to[l] = static_cast<float>(v[l]);
}
// The numbers of a part that begins with element `at`, in an array of groups as wide as 64 bytes.
template <class Real>
ACUS_INLINE void store_numbers(std::vector<Real>& array, std::size_t at, int numbers, const Lane* from) {
  constexpr std::size_t group = numeric::lane_count<Real>;
  Real* to = &array[numbers * (at / group * group) + at % group];
  for (int k = 0; k < numbers; ++k) store_part(to + k * group, from[k]);
}

// One element by itself, from its rest state, whatever it was before and is now.
void rotate_safely(Part& b, int l, const double* gradient) {
  Mat3 G, E;
  for (int k = 0; k < 9; ++k) {
    G.data()[k] = gradient[k * lanes + l];
    E.data()[k] = b.edge[k][l];
  }
  const Mat3 F = E * G.transpose();
  const Mat3 Q = F.allFinite() ? Mat3(numeric::rotation_of(F) * G) : G;
  for (int k = 0; k < 9; ++k) b.q[k][l] = Q.data()[k];
}

// The rotations of a batch from those before, by as many corrections as its fastest element needs. Returns
// for how many they failed and were made up for.
ACUS_INLINE int follow(Part* batch, const double* gradient) {
  Lane change[parts], margin[parts];
  bool converged = false;
  for (int step = 0; step < tracked_turn_most && !converged; ++step) {
    for (int p = 0; p < parts; ++p) {
      Lane b[9];
      gradient_of(b, batch[p].edge, batch[p].q);
      margin[p] = correct_rotation(batch[p].q, b, change[p]);
    }
    converged = numeric::sum(change) < tracked_turn_converged;
  }
  if (converged && numeric::least(margin) > 0.0) return 0;
  int failures = 0;
  for (int p = 0; p < parts; ++p)
    for (int l = 0; l < width; ++l) {
      if (change[p][l] < tracked_turn_converged && margin[p][l] > 0.0) continue;
      rotate_safely(batch[p], l, gradient + p * width);
      ++failures;
    }
  return failures;
}

// Where a part's numbers of a Maxwell branch are kept.
struct BranchPart {
  const RelaxationStep& step;
  double* spring;
  double* strain;
  const double* gradient;  // at rest
};

// Takes a branch to the deviator of the strain `e`; its energy and what it spends go to `sums`. Returns in
// `pull` V times the stress that is left of it at the end of the next step, xx yy zz xy xz yz.
ACUS_INLINE void relax(Lane& energy, Lane& relaxed, const BranchPart& branch, Lane* pull, const Lane* e,
                       Lane two_mu_v) {
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
  energy += 0.5 * modulus * stored;
  relaxed += modulus * spent;
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

// R of R G = Q, from G's cofactors.
ACUS_INLINE void rotation_between(Lane* r, const Lane* g, const Lane* q) {
  Lane cofactor[9];
  for (int k = 0; k < 3; ++k) {
    const Lane* a = g + 3 * ((k + 1) % 3);
    const Lane* b = g + 3 * ((k + 2) % 3);
    for (int i = 0; i < 3; ++i)
      cofactor[3 * k + i] = a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3];
  }
  const Lane inverse = 1.0 / (g[0] * cofactor[0] + g[1] * cofactor[1] + g[2] * cofactor[2]);
  for (int c = 0; c < 3; ++c)
    for (int i = 0; i < 3; ++i)
      r[3 * c + i] = inverse * (q[i] * cofactor[c] + q[3 + i] * cofactor[3 + c] + q[6 + i] * cofactor[6 + c]);
}

// A symmetric tensor from the frame of the element to that of space, R T R^T, or back.
enum class Way { forward, back };
template <Way way>
ACUS_INLINE void turn_tensor(Lane* out, const Lane* r, const Lane* t) {
  constexpr int row = way == Way::forward ? 1 : 3, column = way == Way::forward ? 3 : 1;
  constexpr int first[6] = {0, 1, 2, 0, 0, 1}, second[6] = {0, 1, 2, 1, 2, 2};
  Lane half[3][3];  // T times the turned axes
  for (int i = 0; i < 3; ++i) {
    const Lane x = r[row * i], y = r[row * i + column], z = r[row * i + 2 * column];
    half[i][0] = t[0] * x + t[3] * y + t[4] * z;
    half[i][1] = t[3] * x + t[1] * y + t[5] * z;
    half[i][2] = t[4] * x + t[5] * y + t[2] * z;
  }
  for (int k = 0; k < 6; ++k) {
    const Lane* a = r + row * first[k];
    const Lane* h = half[second[k]];
    out[k] = a[0] * h[0] + a[column] * h[1] + a[2 * column] * h[2];
  }
}

// What a Maxwell branch adds to -V sigma, and what its skew part adds to the forces on corners 1 to 3. The
// branch lives in the frame of the element.
ACUS_INLINE void add_branch(const Part& b, Sums& sums, int part, const BranchPart& branch, Lane* s, Lane* z,
                            const Lane* strain, Lane two_mu_v) {
  Lane g[9], r[9], strain_at_rest[6], pull_at_rest[6], pull[6];
  for (int k = 0; k < 9; ++k) g[k] = load_part<Lane>(branch.gradient + k * lanes);
  rotation_between(r, g, b.q);
  turn_tensor<Way::back>(strain_at_rest, r, strain);
  const Lane third = (strain[0] + strain[1] + strain[2]) / 3.0;
  for (int k = 0; k < 3; ++k) strain_at_rest[k] -= third;
  relax(sums.energy[part], sums.relaxed[part], branch, pull_at_rest, strain_at_rest, two_mu_v);
  turn_tensor<Way::forward>(pull, r, pull_at_rest);
  for (int k = 0; k < 6; ++k) s[k] -= pull[k];
  const Lane stretch[6] = {strain[0] + 1.0, strain[1] + 1.0, strain[2] + 1.0,
                           strain[3],       strain[4],       strain[5]};
  skew_stress(z, stretch, pull);
}

// Strain, energy and stress. `branch` is a BranchPart, or nothing.
template <class... Branch>
ACUS_INLINE void strain(Part& b, Sums& sums, int part, Lane volume, Lane quarter_volume, Lane mu, Lane lambda,
                        const Branch&... branch) {
  Lane f[9];
  gradient_of(f, b.edge, b.q);
  const Lane e[6] = {f[0] - 1.0,          f[4] - 1.0,          f[8] - 1.0,
                     0.5 * (f[1] + f[3]), 0.5 * (f[2] + f[6]), 0.5 * (f[5] + f[7])};
  const Lane trace = e[0] + e[1] + e[2];
  const Lane square =
      e[0] * e[0] + e[1] * e[1] + e[2] * e[2] + 2.0 * (e[3] * e[3] + e[4] * e[4] + e[5] * e[5]);
  sums.energy[part] += volume * (mu * square + 0.5 * lambda * trace * trace);
  const Lane minus_two_mu_v = -2.0 * mu * volume, minus_bulk_v = -lambda * volume * trace;
  for (int k = 0; k < 6; ++k) b.stress[k] = minus_two_mu_v * e[k];
  for (int k = 0; k < 3; ++k) b.stress[k] += minus_bulk_v;
  b.stress[6] = quarter_volume * trace;
  if constexpr (sizeof...(branch) > 0)
    add_branch(b, sums, part, branch..., b.stress, b.stress + stress_numbers, e, 2.0 * mu * volume);
}

// Takes the elements to the positions in `field`. `branch` is a MaxwellBranch, or nothing.
template <class... Branch>
ACUS_INLINE Sums each_element(Range elements, Corotation& out, const TissueModel& m, Branch&... branch) {
  const int numbers = numbers_of_stress(m);
  const bool single = !out.single.numbers.empty();
  Sums sums;
  for (std::size_t pair = elements.first / 2; pair < elements.last / 2; pair += lanes) {
    const Offsets* offsets = m.offsets.data() + pair;
    Lane edge[parts][12];
    for (int p = 0; p < parts; ++p) gather_edges(edge[p], out.field.data(), offsets + p * width);
    ACUS_UNROLL
    for (int side = 0; side < 2; ++side) {
      const std::size_t first = element_of_pair(pair, side);
      Part batch[parts];
      const double* gradient = &m.gradient[9 * first];
      double* q = &out.rotated_gradient[9 * first];
      for (int p = 0; p < parts; ++p) {
        edges_of_side(batch[p].edge, edge[p], side);
        for (int k = 0; k < 9; ++k) batch[p].q[k] = load_part<Lane>(q + p * width + k * lanes);
      }
      sums.safe_rotations += follow(batch, gradient);
      for (int p = 0; p < parts; ++p) {
        Part& b = batch[p];
        const std::size_t at = first + p * width;
        [[maybe_unused]] const std::size_t of_branch = strain_numbers * first + p * width;
        store_numbers(out.rotated_gradient, at, 9, b.q);
        store_numbers(out.single_gradient, at, 9, b.q);
        strain(b, sums, p, load_part<Lane>(&m.volume[at]), load_part<Lane>(&m.quarter_volume[at]),
               load_part<Lane>(&m.shear[at]), load_part<Lane>(&m.local_lambda[at]),
               BranchPart{m.relaxation, &branch.spring[of_branch], &branch.strain[of_branch],
                          gradient + p * width}...);
        if (sizeof...(branch) == 0)
          for (int k = stress_numbers; k < numbers; ++k) b.stress[k] = Lane{};
        if (single)
          store_numbers(out.single.numbers, at, numbers, b.stress);
        else
          store_numbers(out.exact.numbers, at, numbers, b.stress);
      }
    }
  }
  return sums;
}

// Clone by clone: what is handed to a team is not.
ACUS_KERNEL Sums take_elements(Range elements, Corotation& out, const TissueModel& m) {
  return each_element(elements, out, m);
}
ACUS_KERNEL Sums take_elements(Range elements, Corotation& out, const TissueModel& m, MaxwellBranch& branch) {
  return each_element(elements, out, m, branch);
}

// Mean dilations and their pressures from the sums beside the forces, which are cleared. Returns `energy`
// with that of the pressures.
template <class Real>
double dilate(Real* sum, Range nodes, Corotation& out, StressesOf<Real>& stresses, const TissueModel& m,
              double energy) {
  for (std::size_t a = nodes.first; a < nodes.last; ++a) {
    Real& dilated = sum[node_stride * a + 3];
    out.dilation[a] = dilated / m.node_volume[a];
    const double pressure = -m.node_bulk_modulus[a] * out.dilation[a];
    energy -= 0.5 * pressure * dilated;
    stresses.pressure[node_stride * a + 3] = static_cast<Real>(pressure);
    dilated = Real{};
  }
  return energy;
}

// `branch` is a MaxwellBranch, or nothing.
template <class Real, class... Branch>
void evaluate(Corotation& out, StressesOf<Real>& stresses, const std::vector<Real>& gradient,
              const TissueModel& m, std::span<const Vec3> positions, const Team& team, Branch&... branch) {
  numeric::each_piece(out.field.size(), team, [&](Range r) {
    for (std::size_t at = r.first; at < r.last; at += node_stride)
      numeric::store4(&out.field[at], numeric::load3(positions[at / node_stride].data()));
  });
  std::array<Sums, most_streams> sums;
  m.streams.add(stresses.parts, team, [&](Real* to, Range elements, int stream) {
    sums[stream] = take_elements(elements, out, m, branch...);
    add_forces(to, m, elements, stresses, gradient);
  });
  out.energy = out.relaxed = 0.0;
  out.safe_rotations = 0;
  for (int s = 0; s < m.streams.count(); ++s) {
    out.energy += numeric::sum(sums[s].energy);
    out.relaxed += numeric::sum(sums[s].relaxed);
    out.safe_rotations += sums[s].safe_rotations;
  }
  if (m.kind == ElementKind::nodal_pressure) {
    std::array<double, numeric::most_pieces> energy{out.energy};
    m.streams.sum(stresses.parts, team, [&](Real* sum, Range nodes, int piece) {
      energy[piece] = dilate(sum, nodes, out, stresses, m, energy[piece]);
    });
    out.energy = energy[0];
    for (int piece = 1; piece < numeric::most_pieces; ++piece) out.energy += energy[piece];
    m.streams.add(stresses.parts, team, [&](Real* to, Range elements, int) {
      press(to, m, elements, gradient, stresses.pressure);
    });
  }
  m.streams.sum(stresses.parts, team, [&](Real* sum, Range nodes, int) {
    for (std::size_t at = node_stride * nodes.first; at < node_stride * nodes.last; at += node_stride) {
      for (int c = 0; c < 3; ++c) out.elastic_force[at + c] = sum[at + c];
      numeric::store4(sum + at, numeric::NodeLane<Real>{});
    }
  });
  out.finite = std::isfinite(out.energy);
}

template <class... Branch>
void evaluate(Corotation& out, const TissueModel& m, std::span<const Vec3> positions, const Team& team,
              Branch&... branch) {
  if (out.single.numbers.empty())
    evaluate(out, out.exact, out.rotated_gradient, m, positions, team, branch...);
  else
    evaluate(out, out.single, out.single_gradient, m, positions, team, branch...);
}

}  // namespace

Corotation build_corotation(const TissueModel& model, ForcePrecision precision) {
  Corotation c;
  c.rotated_gradient = model.gradient;
  c.single_gradient.assign(model.gradient.size(), 0.0F);
  c.elastic_force.assign(static_cast<std::size_t>(model.nodes) * node_stride, 0.0);
  c.field = c.elastic_force;
  if (precision == ForcePrecision::single)
    c.single = build_stresses<float>(model);
  else
    c.exact = build_stresses<double>(model);
  if (model.kind == ElementKind::nodal_pressure) c.dilation.assign(model.nodes, 0.0);
  return c;
}

void corotate_into(Corotation& out, const TissueModel& model, std::span<const Vec3> positions,
                   const Team& team) {
  evaluate(out, model, positions, team);
}

void corotate_into(Corotation& out, MaxwellBranch& branch, const TissueModel& model,
                   std::span<const Vec3> positions, const Team& team) {
  if (!model.relaxation.relaxes()) return evaluate(out, model, positions, team);
  evaluate(out, model, positions, team, branch);
}

}  // namespace acus::tissue
