#include "acus/coupling/near_field.h"

#include <algorithm>
#include <numbers>

#include "acus/numeric/logarithm.h"

namespace acus::coupling {

NearField near_field(double shear_modulus, double poisson_ratio, double edge, double radius) {
  const double reach = std::max(near_field_reach * edge / radius, 1.0);
  const double ring = std::max(numeric::log(reach), near_field_thinnest);
  const double pi = std::numbers::pi;
  return {8.0 * pi * shear_modulus * (1.0 - poisson_ratio) / ((3.0 - 4.0 * poisson_ratio) * ring),
          2.0 * pi * shear_modulus / ring};
}

}  // namespace acus::coupling
