#include "acus/sim/hill.h"

#include <algorithm>
#include <cmath>

namespace acus {
namespace {

// a / P0 of Hill's law: about a quarter in the muscles that Hill measured.
constexpr double curvature = 0.25;
// Slowly stretched, a muscle gives way with a sixth of the speed per force that it shortens with (Katz).
constexpr double stretched_share = 1.0 / 6.0;

}  // namespace

// Hill: (P + a) v = b (P0 - P), with b = v0 a / P0.
// Symbols: P load N, P0 limit N, v speed m/s, v0 unloaded speed m/s.
double hill_speed(double load, double unloaded_speed, double limit) {
  const double p = std::max(load / limit, 0.0);
  if (p <= 1.0) return unloaded_speed * (1.0 - p) / (1.0 + p / curvature);
  const double slope_at_limit = unloaded_speed / (1.0 + 1.0 / curvature);
  return stretched_share * slope_at_limit * (1.0 - p);
}

double hill_half_speed_load(double limit) { return limit / (2.0 + 1.0 / curvature); }

double hill_steepest_fall(double unloaded_speed, double limit) {
  return unloaded_speed / limit * (1.0 + 1.0 / curvature);  // where the load begins
}

}  // namespace acus
