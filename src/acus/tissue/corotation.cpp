#include "acus/tissue/corotation.h"

#include <array>
#include <cmath>

#include "acus/numeric/polar.h"
#include "acus/tissue/branch_lanes.h"
#include "acus/tissue/deformation.h"
#include "acus/tissue/pair_sums.h"
#include "acus/tissue/pressure.h"

namespace acus::tissue {
namespace {

using numeric::node_stride;
using numeric::Range;

// Elements side by side. Matrices are column by column: entry (r, c) at 3 c + r.
template <class Lane>
struct Part {
  Lane h[9];  // gradient of the displacement at rest, F - I
  Lane turn[turn_numbers];
  Lane r[9];  // R - I
  Lane b[9];  // F R^T - I
};

template <class Lane>
ACUS_INLINE void stretch_part(Part<Lane>& p) {
  turn_less_identity(p.r, p.turn);
  stretch_less_identity(p.b, p.r, p.h);
}

// Where the elements are to go.
struct There {
  const TissueModel& model;
  std::span<const Vec3> positions;
};

// The turn of one element by itself, whatever it was before and is now.
template <class Lane>
void turn_safely(Part<Lane>& p, int l, const There& there, std::size_t element) {
  const Mat3 F = deformation_of_element(there.model, there.positions, element);
  Eigen::Quaterniond turn = Eigen::Quaterniond::Identity();
  if (F.allFinite()) turn = Eigen::Quaterniond(numeric::rotation_of(F));
  for (int k = 0; k < turn_numbers; ++k) p.turn[k][l] = static_cast<RealOf<Lane>>(turn.coeffs()[k]);
}

// Whether a mask has nothing set.
template <class Mask>
ACUS_INLINE bool none(const Mask& mask) {
  std::uint64_t words[sizeof mask / sizeof(std::uint64_t)], all = 0;
  std::memcpy(words, &mask, sizeof mask);
  for (const std::uint64_t word : words) all |= word;
  return all == 0;
}

// Its rotations from those before, each by as many corrections as it needs. Returns for how many of them,
// `first` the first element's number, that failed and was made up for.
template <class Lane>
ACUS_INLINE int follow(Part<Lane>& p, const There& there, std::size_t first) {
  constexpr auto converged = static_cast<RealOf<Lane>>(tracked_turn_converged);
  Lane change, margin = correct_turn(p.turn, p.b, change);
  auto moving = !(change < converged);
  for (int step = 1; step < tracked_turn_most && !none(moving); ++step) {
    stretch_part(p);
    Lane turn[turn_numbers], new_change;
    for (int k = 0; k < turn_numbers; ++k) turn[k] = p.turn[k];
    const Lane new_margin = correct_turn(turn, p.b, new_change);
    for (int k = 0; k < turn_numbers; ++k) p.turn[k] = moving ? turn[k] : p.turn[k];
    change = moving ? new_change : change;
    margin = moving ? new_margin : margin;
    moving = !(change < converged);
  }
  const auto failed = moving | !(margin > Lane{});
  if (none(failed)) return 0;
  int failures = 0;
  for (int l = 0; l < lanes_in<RealOf<Lane>, Lane>; ++l) {
    if (failed[l] == 0) continue;
    turn_safely(p, l, there, first + static_cast<std::size_t>(l));
    ++failures;
  }
  return failures;
}

// What a kernel sums up over the elements of a stream.
struct Sums {
  double energy = 0.0, relaxed = 0.0;
  int safe_rotations = 0;
};

// Lane by lane.
template <class Lane>
struct LaneSums {
  static constexpr int parts = numeric::lane_count<RealOf<Lane>> / lanes_in<RealOf<Lane>, Lane>;
  numeric::Wide<Lane> energy[parts]{}, relaxed[parts]{};
  int safe_rotations = 0;
};
// -V sigma, with what a branch adds to it and to the forces; its energy. `branch` is a BranchPart, or
// nothing.
template <class Lane, class... Branch>
ACUS_INLINE void strain(Lane (*force)[4], const Part<Lane>& p, const Lane* q, numeric::Wide<Lane>& energy,
                        [[maybe_unused]] numeric::Wide<Lane>& relaxed, Lane mu_v, Lane lambda_v,
                        Lane quarter_volume, const Branch&... branch) {
  constexpr RealOf<Lane> half = 0.5, two = 2.0;
  const Lane* b = p.b;
  const Lane e[6] = {b[0], b[4], b[8], half * (b[1] + b[3]), half * (b[2] + b[6]), half * (b[5] + b[7])};
  const Lane trace = e[0] + e[1] + e[2];
  const Lane square =
      e[0] * e[0] + e[1] * e[1] + e[2] * e[2] + two * (e[3] * e[3] + e[4] * e[4] + e[5] * e[5]);
  energy += numeric::widened(mu_v * square + half * lambda_v * trace * trace);
  const Lane minus_two_mu_v = -two * mu_v, minus_bulk_v = -lambda_v * trace;
  Lane stress[6];
  for (int k = 0; k < 6; ++k) stress[k] = minus_two_mu_v * e[k];
  for (int k = 0; k < 3; ++k) stress[k] += minus_bulk_v;
  if constexpr (sizeof...(branch) > 0) {
    Lane z[3];
    add_branch(energy, relaxed, branch..., stress, z, p.r, e, two * mu_v);
    corner_forces(force, stress, q);
    add_skew_forces(force, z, q);
  } else {
    corner_forces(force, stress, q);
  }
  for (int i = 0; i < 4; ++i) force[i][3] = quarter_volume * trace;
}

// Numbers of the elements that begin with `first`, where place_of has them.
template <class Lane>
ACUS_INLINE void store_numbers(RealOf<Lane>* to, const Lane* from, int numbers) {
  for (int k = 0; k < numbers; ++k)
    std::memcpy(to + k * numeric::lane_count<RealOf<Lane>>, &from[k], sizeof from[k]);
}
template <class Lane>
ACUS_INLINE void store_rounded(float* to, const Lane* from, int numbers) {
  using Rounded = numeric::LaneOf<float, sizeof(Lane) / 2>;
  for (int k = 0; k < numbers; ++k) {
    const auto rounded = __builtin_convertvector(from[k], Rounded);
    std::memcpy(to + k * numeric::lane_count<float>, &rounded, sizeof rounded);
  }
}

// Takes the elements to the displacements in `at` and adds their forces, with their shares of the dilations
// as fourth numbers. `branch` is a MaxwellBranch, or nothing.
template <class Lane, class Real, class... Branch>
ACUS_INLINE Sums each_element(Real* to, Range elements, Corotation& out, RotatedElements<Real>& at,
                              const ElementsAtRest<Real>& rest, const There& there, Branch&... branch) {
  const ElementNumbers<Lane> gradients(rest.gradient, 9), moduli(rest.moduli, element_moduli),
      quarters(rest.quarter_volume, 1), turns(at.turn, turn_numbers);
  const TissueModel& m = there.model;
  LaneSums<Lane> sums;
  add_pairs<Lane>(
      to, m, elements, [&](std::size_t pair, int part, const Offsets* offsets, Lane(*node)[4]) ACUS_INLINED {
        Lane pair_edge[12];
        gather_narrowed_edges(pair_edge, out.displacement.data(), offsets);
        ACUS_UNROLL
        for (int side = 0; side < 2; ++side) {
          const std::size_t first = element_of_pair(pair, side);
          const std::size_t own = first + static_cast<std::size_t>(part) * lanes_in<Real, Lane>;
          Part<Lane> p;
          Lane edge[9], g[9], q[9];
          edges_of_side(edge, pair_edge, side);
          const auto gradient = gradients.of(first, part), turn = turns.of(first, part);
          for (int k = 0; k < 9; ++k) g[k] = gradient[k];
          for (int k = 0; k < turn_numbers; ++k) p.turn[k] = turn[k];
          gradient_of(p.h, edge, g);
          stretch_part(p);
          sums.safe_rotations += follow(p, there, own);
          stretch_part(p);
          turn_gradients(q, p.r, g);
          store_numbers(&at.turn[place_of<Real>(own, 0, turn_numbers)], p.turn, turn_numbers);
          store_numbers(&at.gradient[place_of<Real>(own, 0, 9)], q, 9);
          if constexpr (std::is_same_v<Real, double>)
            store_rounded(&out.single.gradient[place_of<float>(own, 0, 9)], q, 9);
          [[maybe_unused]] const std::size_t of_branch = place_of<float>(own, 0, strain_numbers);
          const auto modulus = moduli.of(first, part);
          Lane force[4][4];
          strain(force, p, q, sums.energy[part], sums.relaxed[part], modulus[0], modulus[1],
                 quarters.of(first, part)[0],
                 BranchPart{m.relaxation, &branch.spring[of_branch], &branch.strain[of_branch]}...);
          put_corners(node, force, side);
        }
      });
  return {numeric::sum(sums.energy), numeric::sum(sums.relaxed), sums.safe_rotations};
}

template <class Real, class... Branch>
Sums take_elements(Real* to, Range elements, Corotation& out, RotatedElements<Real>& at,
                   const ElementsAtRest<Real>& rest, const There& there, Branch&... branch) {
  Sums sums;
  numeric::run_kernel([&](auto bytes) ACUS_INLINED {
    sums = each_element<numeric::LaneOf<Real, bytes>>(to, elements, out, at, rest, there, branch...);
  });
  return sums;
}

// Mean dilations and their pressures from the sums beside the forces, which are cleared. Returns `energy`
// with that of the pressures.
template <class Real>
double dilate(Real* sum, Range nodes, Corotation& out, RotatedElements<Real>& at, const TissueModel& m,
              double energy) {
  for (std::size_t a = nodes.first; a < nodes.last; ++a) {
    Real& dilated = sum[node_stride * a + 3];
    out.dilation[a] = dilated / m.node_volume[a];
    const double pressure = -m.node_bulk_modulus[a] * out.dilation[a];
    energy -= 0.5 * pressure * dilated;
    at.pressure[node_stride * a + 3] = static_cast<Real>(pressure);
    dilated = Real{};
  }
  return energy;
}

// `branch` is a MaxwellBranch, or nothing.
template <class Real, class... Branch>
void evaluate(Corotation& out, RotatedElements<Real>& at, const ElementsAtRest<Real>& rest,
              const TissueModel& m, std::span<const Vec3> positions, const Team& team, Branch&... branch) {
  numeric::each_piece(out.displacement.size(), team, [&](Range r) {
    for (std::size_t i = r.first; i < r.last; i += node_stride) {
      const Vec3 u = positions[i / node_stride] - m.rest[i / node_stride];
      for (int c = 0; c < 3; ++c) out.displacement[i + c] = u[c];
    }
  });
  std::array<Sums, most_streams> sums;
  m.streams.add(at.parts, team, [&](Real* to, Range elements, int stream) {
    sums[stream] = take_elements(to, elements, out, at, rest, {m, positions}, branch...);
  });
  out.energy = out.relaxed = 0.0;
  out.safe_rotations = 0;
  for (int s = 0; s < m.streams.count(); ++s) {
    out.energy += sums[s].energy;
    out.relaxed += sums[s].relaxed;
    out.safe_rotations += sums[s].safe_rotations;
  }
  if (m.kind == ElementKind::nodal_pressure) {
    std::array<double, numeric::most_pieces> energy{out.energy};
    m.streams.sum(at.parts, team, [&](Real* sum, Range nodes, int piece) {
      energy[piece] = dilate(sum, nodes, out, at, m, energy[piece]);
    });
    out.energy = energy[0];
    for (int piece = 1; piece < numeric::most_pieces; ++piece) out.energy += energy[piece];
    m.streams.add(at.parts, team,
                  [&](Real* to, Range elements, int) { press(to, m, elements, at.gradient, at.pressure); });
  }
  m.streams.sum(at.parts, team, [&](Real* sum, Range nodes, int) {
    for (std::size_t i = node_stride * nodes.first; i < node_stride * nodes.last; i += node_stride) {
      for (int c = 0; c < 3; ++c) out.elastic_force[i + c] = sum[i + c];
      numeric::store4(sum + i, numeric::NodeLane<Real>{});
    }
  });
  out.finite = std::isfinite(out.energy);
}

template <class... Branch>
void evaluate(Corotation& out, const TissueModel& m, std::span<const Vec3> positions, const Team& team,
              Branch&... branch) {
  if (out.is_single())
    evaluate(out, out.single, m.single, m, positions, team, branch...);
  else
    evaluate(out, out.exact, m.exact, m, positions, team, branch...);
}

template <class Real>
void begin(RotatedElements<Real>& at, const ElementsAtRest<Real>& rest, const TissueModel& m) {
  at.gradient = rest.gradient;
  at.turn.assign(turn_numbers * m.corners.size(), Real{});
  for (std::size_t e = 0; e < m.corners.size(); ++e) at.turn[place_of<Real>(e, 3, turn_numbers)] = Real{1};
  const std::size_t size = static_cast<std::size_t>(m.nodes) * node_stride;
  at.parts.assign(m.streams.count() * size, Real{});
  if (m.kind == ElementKind::nodal_pressure) at.pressure.assign(size, Real{});
}

}  // namespace

Corotation build_corotation(const TissueModel& model, ForcePrecision precision) {
  Corotation c;
  c.elastic_force.assign(static_cast<std::size_t>(model.nodes) * node_stride, 0.0);
  c.displacement = c.elastic_force;
  if (precision == ForcePrecision::single) {
    begin(c.single, model.single, model);
  } else {
    begin(c.exact, model.exact, model);
    c.single.gradient = model.single.gradient;
  }
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
