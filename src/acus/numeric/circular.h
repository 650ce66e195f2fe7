// Sine, cosine and arc functions from sums, products and roots alone. Those of C libraries differ in the last
// bit from one library to the next, and a simulation would then give other bits in a browser.
#pragma once

namespace acus::numeric {

// Good to two units in the last place for |x| up to 1e5; not a number beyond 1e8.
double sin(double x);
double cos(double x);
double atan(double x);
// Good to four units.
double tan(double x);
double asin(double x);  // -1 <= x <= 1

}  // namespace acus::numeric
