// The equation of motion M a + D v + f_int(x) = f_ext (paper Eq. 7) by linearly implicit Euler:
//   (M + h D + h^2 K') v1 = M v0 + h (f_el(x0) + f_ext),   x1 = x0 + h v1,
// with Rayleigh damping D = alpha M + beta K', hence A = (1 + h alpha) M + (h^2 + h beta) K'.
#pragma once

#include <span>
#include <vector>

#include "acus/base/vec.h"
#include "acus/tissue/corotation.h"
#include "acus/tissue/system_matrix.h"

namespace acus::tissue {

struct Rayleigh {
  double mass = 0.0;       // alpha, 1/s
  double stiffness = 0.0;  // beta, s
};

struct StepFactors {
  double mass = 1.0;       // of M in A
  double stiffness = 0.0;  // of K' in A, s^2
};
inline StepFactors step_factors(double h, const Rayleigh& damping) {
  return {1.0 + h * damping.mass, h * h + h * damping.stiffness};
}

// b = M v0 + h f_el over the free nodes; external impulses h f_ext are added to it by the caller.
void momentum_into(numeric::NodeVector& b, const TissueModel& model, const numeric::NodeVector& velocity,
                   const numeric::NodeVector& elastic_force, double h, const Team& team = one_thread);

// x += h v for the free nodes.
void move(std::vector<Vec3>& positions, const numeric::NodeVector& velocity, double h,
          const Team& team = one_thread);

// v . M v over the free nodes, kg m^2/s^2 (twice the kinetic energy).
double mass_product(const TissueModel& model, const numeric::NodeVector& v, const Team& team = one_thread);

}  // namespace acus::tissue
