// Elliptic integrals of the first and second kind by the arithmetic-geometric mean
// (Abramowitz and Stegun 17.6), in terms of the modulus k (m = k^2), accurate to about 1e-15.
#pragma once

namespace acus::numeric {

// The mean that the sequences a' = (a + b)/2, b' = sqrt(a b) share. a, b > 0.
double arithmetic_geometric_mean(double a, double b);

struct EllipticIntegrals {
  double first;   // F or K
  double second;  // E
};

// K(k), E(k): the integrals of (1 - k^2 sin^2 t)^(-1/2) and (1 - k^2 sin^2 t)^(1/2) over 0 <= t <= pi/2. 0 <=
// k < 1.
EllipticIntegrals complete_elliptic(double modulus);

// F(phi, k), E(phi, k): the same integrals over 0 <= t <= phi, for any finite phi [rad]. 0 <= k < 1.
EllipticIntegrals incomplete_elliptic(double phi, double modulus);

// The inverse of F: am(u, k) with F(am(u, k), k) = u, for any finite u. 0 <= k < 1. rad
double jacobi_amplitude(double u, double modulus);

}  // namespace acus::numeric
