// Isotropic linear elasticity (Hooke), as the paper's Eq. 3 takes it.
#pragma once

namespace acus::tissue {

struct Material {
  double youngs_modulus = 25e3;  // Pa, > 0
  double poisson_ratio = 0.48;   // in (-1, 0.5)
  double density = 1000.0;       // kg/m^3, > 0
};

// Symbols: E Young's modulus, nu Poisson's ratio; mu, lambda Lame's constants, kappa the bulk modulus. All
// Pa.
inline double shear_modulus(const Material& m) { return m.youngs_modulus / (2.0 * (1.0 + m.poisson_ratio)); }
inline double lame_lambda(const Material& m) {
  return m.youngs_modulus * m.poisson_ratio / ((1.0 + m.poisson_ratio) * (1.0 - 2.0 * m.poisson_ratio));
}
inline double bulk_modulus(const Material& m) {
  return m.youngs_modulus / (3.0 * (1.0 - 2.0 * m.poisson_ratio));
}

}  // namespace acus::tissue
