// Where an axis puts its ticks, and how it writes them.
#pragma once

#include <string>
#include <vector>

namespace acus::study {

struct Ticks {
  std::vector<double> at;  // ascending, all within [low, high]
  double step = 1.0;       // 1, 2 or 5 times a power of ten
};

// Whether low and high are finite, low is below high, and by more than rounding.
bool has_span(double low, double high);

// About `wanted` ticks at round numbers within [low, high]; one at `low` where that has no span.
Ticks axis_ticks(double low, double high, int wanted);

// `value` with the decimals that tell neighbours `step` apart: tick_label(0.3, 0.1) is "0.3".
std::string tick_label(double value, double step);

// `value` with at most `digits` significant digits and no trailing zeros; never in exponent form.
std::string short_number(double value, int digits);

}  // namespace acus::study
