// How fast a muscle moves against a load.
#pragma once

namespace acus {

// Speed at which a hand that would go at `unloaded_speed` [m/s] moves on against `load` [N], when it can just
// hold `limit` [N]: all of it without load, nothing at the limit, and backwards beyond it. A load that pulls
// the hand on makes it no faster. (A. V. Hill, Proc. R. Soc. B 126:136, 1938; beyond the limit B. Katz,
// J. Physiol. 96:45, 1939.) m/s
double hill_speed(double load, double unloaded_speed, double limit);

// Load under which that is half of the unloaded speed. N
double hill_half_speed_load(double limit);

// Largest amount by which that speed falls for each newton of load. m/s/N
double hill_steepest_fall(double unloaded_speed, double limit);

}  // namespace acus
