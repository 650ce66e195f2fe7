// The natural logarithm from sums, products and quotients alone, for the same bits on every machine
// (circular.h).
#pragma once

namespace acus::numeric {

// Good to four units in the last place for finite x >= 1.
double log(double x);

}  // namespace acus::numeric
