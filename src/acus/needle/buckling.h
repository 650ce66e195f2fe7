// The load at which a straight column buckles (paper, Eq. 10), for four pairs of end supports.
#pragma once

#include "acus/needle/needle_spec.h"

namespace acus::needle {

// The least positive root of tan z = z (first zero of the spherical Bessel function j_1, Abramowitz and
// Stegun Table 10.6): the clamped-pinned column buckles at z = l sqrt(P / EI).
inline constexpr double clamped_pinned_root = 4.493409457909064;

// Critical load as a multiple of the pinned-pinned one: 1, 2.0457, 4, 1/4 (Timoshenko and Gere, Theory of
// Elastic Stability, 2.2). Clamped-pinned is clamped_pinned_root^2 / pi^2.
double critical_load_factor(Support support);

// Eq. 10 with the factor of the supports. N
// Symbols: EI = bending_rigidity [N m^2] > 0, l = free_length [m] > 0.
double critical_load(double bending_rigidity, double free_length, Support support);

// The critical load of a clamped column whose tip, free to rotate, is held sideways by a spring of
// `lateral_stiffness` [N/m] >= 0: the tissue's give. From clamped-free (0) to clamped-pinned (infinite). N
double critical_load_with_lateral_spring(double bending_rigidity, double free_length,
                                         double lateral_stiffness);

}  // namespace acus::needle
