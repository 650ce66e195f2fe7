// What a mesh coarser than the needle cannot give way by: the tissue close to the shaft.
//
// A line that pulls on elements of edge h moves tissue as a sleeve of radius beta h would, not of its own radius r. The ring
// between is missing, and its compliance belongs in series with the mesh's, or forces depend on the mesh by a logarithm.
#pragma once

namespace acus::coupling {

struct NearField {
  double lateral = 0.0;  // N/m^2: stiffness per length across the shaft
  double axial = 0.0;    // N/m^2: along it
};

// Plane strain around a line load across, (3 - 4 nu) / (8 pi G (1 - nu)) ln(beta h / r), and antiplane shear along, ln(beta h /
// r) / (2 pi G) (Love 1927). Symbols: G = shear_modulus [Pa], nu = poisson_ratio, h = edge [m] of the elements, r = radius [m] of
// the shaft. Where the elements are as fine as the shaft the ring has no thickness left; it then counts as `thinnest`.
NearField near_field(double shear_modulus, double poisson_ratio, double edge, double radius);

inline constexpr double near_field_reach = 0.3;      // beta
inline constexpr double near_field_thinnest = 0.05;  // of the logarithm

}  // namespace acus::coupling
