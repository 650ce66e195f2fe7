// Work and force of cutting by fracture toughness (paper Eq. 15-16).
#pragma once

#include <numbers>

namespace acus::force {

// A fracture toughness holds only together with the crack it was measured with.
enum class Crack { ring, slit };

// Length of the crack's front across the needle, m: the area it opens per depth. Ring 2 pi r (Eq. 16), slit 2
// r.
inline double crack_width(Crack crack, double radius) {
  return crack == Crack::ring ? 2.0 * std::numbers::pi * radius : 2.0 * radius;
}

// W_c = J_c a(s) (Eq. 15) with a = width * depth, so the tip needs the force J_c * width to cut on (Eq.
// 16-17). Symbols: J_c fracture toughness, J/m^2; r needle radius, m. N
inline double cutting_force(double fracture_toughness, Crack crack, double radius) {
  return fracture_toughness * crack_width(crack, radius);
}

}  // namespace acus::force
