// Logarithm and cube root from sums, products and quotients alone, for the same bits on every machine (circular.h).
#pragma once

namespace acus::numeric {

// Natural; good to four units in the last place for finite x >= 1.
double log(double x);
// Good to two units; finite x > 0.
double cube_root(double x);

}  // namespace acus::numeric
