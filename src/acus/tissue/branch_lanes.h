// What a Maxwell branch (relaxation.h) adds to the stresses of elements side by side.
#pragma once

#include "acus/tissue/relaxation.h"
#include "acus/tissue/tracked_rotation.h"

namespace acus::tissue {

// Where a branch's numbers of some elements are kept.
struct BranchPart {
  const RelaxationStep& step;
  double* spring;
  double* strain;
};

// Takes a branch to the deviator of the strain `e`, times `two_mu_v`; its energy and what it spends are added
// to the sums. Returns in `pull` V times the stress that is left of it at the end of the next step.
template <class Lane>
ACUS_INLINE void relax(numeric::Wide<Lane>& energy, numeric::Wide<Lane>& relaxed, const BranchPart& branch,
                       Lane* pull, const Lane* e, Lane two_mu_v) {
  using Real = RealOf<Lane>;
  using Wide = numeric::Wide<Lane>;
  const RelaxationStep& r = branch.step;
  const auto kept = static_cast<Real>(r.kept), taken = static_cast<Real>(r.taken),
             lead = static_cast<Real>(r.lead), spent_share = static_cast<Real>(r.spent),
             rest = static_cast<Real>(r.rest);
  const Lane modulus = static_cast<Real>(r.modulus) * two_mu_v;
  constexpr int stride = numeric::lane_count<float>;
  Lane stored{}, spent{};
  for (int l = 0; l < strain_numbers; ++l) {
    const Real times = l < 3 ? Real{1} : Real{2};  // a shear stands twice in a tensor
    double *const spring = branch.spring + l * stride, *const strain = branch.strain + l * stride;
    const Wide before = numeric::load_lanes<Wide>(spring);
    const Lane change = e[l] - __builtin_convertvector(numeric::load_lanes<Wide>(strain), Lane);
    const Lane mean = __builtin_convertvector(before, Lane) + lead * change;
    // In double: what a step forgets of it may be less than floats can tell.
    const Wide after = r.kept * before + numeric::widened(taken * change);
    const Lane now = __builtin_convertvector(after, Lane);
    stored += times * now * now;
    spent += times * (spent_share * mean * mean + rest * change * change);
    pull[l] = kept * modulus * now;
    const Wide reached = numeric::widened(e[l]);
    std::memcpy(spring, &after, sizeof after);
    std::memcpy(strain, &reached, sizeof reached);
  }
  energy += numeric::widened(static_cast<Real>(0.5) * modulus * stored);
  relaxed += numeric::widened(modulus * spent);
}

// Where stretch S = R^T F and stress T do not share their axes, as with a branch they need not, the rotation
// itself does work on T: the gradient of the energy is R (T + Z) with the skew Z x = z x x, (tr(S) I - S) z
// twice the axial vector of (S T - T S) / 2. Six numbers xx yy zz xy xz yz each. Bounded where the rotation
// is about to jump.
template <class Lane>
ACUS_INLINE void skew_stress(Lane* z, const Lane* s, const Lane* t) {
  using Real = RealOf<Lane>;
  const Lane twist[3] = {s[4] * t[3] - t[4] * s[3] + s[5] * (t[1] - t[2]) - t[5] * (s[1] - s[2]),
                         s[3] * t[5] - t[3] * s[5] + s[4] * (t[2] - t[0]) - t[4] * (s[2] - s[0]),
                         s[5] * t[4] - t[5] * s[4] + s[3] * (t[0] - t[1]) - t[3] * (s[0] - s[1])};
  const Lane a = s[1] + s[2], b = s[0] + s[2], c = s[0] + s[1];  // tr(S) I - S: its diagonal
  const Lane ab = -s[3], ac = -s[4], bc = -s[5];
  const Lane minor[6] = {b * c - bc * bc,  a * c - ac * ac,  a * b - ab * ab,
                         ac * bc - ab * c, ab * bc - ac * b, ab * ac - a * bc};
  const Lane determinant = a * minor[0] + ab * minor[3] + ac * minor[4];  // 8 at rest
  constexpr Real least = static_cast<Real>(1e-3);
  const Lane inverse = Real{1} / (determinant + least * least / determinant);
  z[0] = inverse * (minor[0] * twist[0] + minor[3] * twist[1] + minor[4] * twist[2]);
  z[1] = inverse * (minor[3] * twist[0] + minor[1] * twist[1] + minor[5] * twist[2]);
  z[2] = inverse * (minor[4] * twist[0] + minor[5] * twist[1] + minor[2] * twist[2]);
}

// A symmetric tensor from the frame of the element to that of space, R T R^T, or back.
enum class Way { forward, back };
template <Way way, class Lane>
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

// What a branch adds to -V sigma, and its skew part, which adds to the forces on corners 1 to 3. The branch
// lives in the frame of the element; `r` is R - I, the strain that of space.
template <class Lane>
ACUS_INLINE void add_branch(numeric::Wide<Lane>& energy, numeric::Wide<Lane>& relaxed,
                            const BranchPart& branch, Lane* s, Lane* z, const Lane* r, const Lane* strain,
                            Lane two_mu_v) {
  using Real = RealOf<Lane>;
  constexpr Real one = 1.0;
  Lane rotation[9], strain_at_rest[6], pull_at_rest[6], pull[6];
  for (int k = 0; k < 9; ++k) rotation[k] = k % 4 == 0 ? r[k] + one : r[k];
  turn_tensor<Way::back>(strain_at_rest, rotation, strain);
  const Lane third = (strain[0] + strain[1] + strain[2]) / Real{3};
  for (int k = 0; k < 3; ++k) strain_at_rest[k] -= third;
  relax(energy, relaxed, branch, pull_at_rest, strain_at_rest, two_mu_v);
  turn_tensor<Way::forward>(pull, rotation, pull_at_rest);
  for (int k = 0; k < 6; ++k) s[k] -= pull[k];
  const Lane stretch[6] = {strain[0] + one, strain[1] + one, strain[2] + one,
                           strain[3],       strain[4],       strain[5]};
  skew_stress(z, stretch, pull);
}

// f_i -= z x q_i of corners 1 to 3, and corner 0 the opposite: the stresses above are negative, too.
template <class Lane>
ACUS_INLINE void add_skew_forces(Lane (*force)[4], const Lane* z, const Lane* q) {
  for (int i = 0; i < 3; ++i) {
    const Lane x = q[3 * i], y = q[3 * i + 1], w = q[3 * i + 2];
    force[i + 1][0] -= z[1] * w - z[2] * y;
    force[i + 1][1] -= z[2] * x - z[0] * w;
    force[i + 1][2] -= z[0] * y - z[1] * x;
  }
  balance_corner_0(force);
}

}  // namespace acus::tissue
