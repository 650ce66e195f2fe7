// What a needle is: the numbers a user chooses.
#pragma once

#include <array>
#include <cmath>
#include <numbers>

namespace acus::needle {

// End supports of the free part, hub first. The effective-length factor of each is its critical_load_factor.
enum class Support { pinned_pinned, clamped_pinned, clamped_clamped, clamped_free };
inline constexpr std::array all_supports = {Support::pinned_pinned, Support::clamped_pinned,
                                            Support::clamped_clamped, Support::clamped_free};

// Defaults are the steel needle of the paper's Table I.
struct NeedleSpec {
  double length = 0.2;            // m, hub to tip, stress-free
  double radius = 0.3e-3;         // m, of the round section
  double inner_radius = 0.0;      // m, of the bore; 0: solid
  double youngs_modulus = 200e9;  // Pa
  double density = 7850.0;        // kg/m^3, stainless steel
  Support support = Support::clamped_pinned;
  double imperfection = 0.05e-3;  // m, amplitude of the initial bow at full length; seeds the bifurcation
  double bevel_degrees = 0.0;     // between the face of the tip and the axis; 0: a tip without a side
  double bevel_turn_degrees =
      0.0;  // about the axis, from the plane of the bow to the side that the tip steers to
};

// A free part shorter than this many radii is a stub, not a column; what follows holds only above it.
inline constexpr double shortest_column = 10.0;

// Symbols: A = pi (r^2 - b^2) [m^2], I = pi (r^4 - b^4) / 4 [m^4], b the bore's radius.
inline double section_area(const NeedleSpec& n) {
  const auto disc = [](double r) { return std::numbers::pi * r * r; };
  return disc(n.radius) - disc(n.inner_radius);
}
inline double bending_rigidity(const NeedleSpec& n) {  // EI, N m^2
  const auto solid = [&](double r) { return n.youngs_modulus * std::numbers::pi * r * r * r * r / 4.0; };
  return solid(n.radius) - solid(n.inner_radius);
}
inline double axial_rigidity(const NeedleSpec& n) { return n.youngs_modulus * section_area(n); }  // EA, N
inline double mass(const NeedleSpec& n) { return n.density * section_area(n) * n.length; }        // kg

// s, of the slowest vibration of a part of that length [m], 2 pi / z^2 l^2 sqrt(rho A / EI) with z = 1.8751
// where the tip is free (Blevins 1979, table 8-1), and else at most that between two pins, z = pi.
inline double slowest_period(const NeedleSpec& n, double length) {
  const double z = n.support == Support::clamped_free ? 1.8751 : std::numbers::pi;
  return 2.0 * std::numbers::pi / (z * z) * length * length *
         std::sqrt(n.density * section_area(n) / bending_rigidity(n));
}

}  // namespace acus::needle
