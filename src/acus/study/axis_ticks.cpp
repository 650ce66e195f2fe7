#include "acus/study/axis_ticks.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

namespace acus::study {
namespace {

std::string fixed(double value, int decimals) {
  char text[64];
  std::snprintf(text, sizeof text, "%.*f", decimals, value);
  std::string out = text;
  const bool zero = out.find_first_not_of("-0.") == std::string::npos;
  return zero && out[0] == '-' ? out.substr(1) : out;
}

}  // namespace

bool has_span(double low, double high) {
  constexpr double rounding = 1e-12;  // of the larger limit
  return std::isfinite(high - low) && high - low > rounding * std::max(std::abs(low), std::abs(high)) &&
         high - low >= std::numeric_limits<double>::min();
}

Ticks axis_ticks(double low, double high, int wanted) {
  if (!has_span(low, high)) return {{low}, 1.0};
  constexpr double hair = 1e-9;  // of a step: a limit that rounding put just past its tick keeps it
  const double rough = (high - low) / wanted;
  const double power = std::pow(10.0, std::floor(std::log10(rough)));
  const double lead = rough / power;
  Ticks ticks;
  // Between two candidates the geometric mean decides.
  ticks.step = power * (lead < std::sqrt(2.0)    ? 1.0
                        : lead < std::sqrt(10.0) ? 2.0
                        : lead < std::sqrt(50.0) ? 5.0
                                                 : 10.0);
  const double first = std::ceil(low / ticks.step - hair);
  const double last = std::floor(high / ticks.step + hair);
  const auto count = static_cast<int>(last - first) + 1;
  for (int i = 0; i < count; ++i) ticks.at.push_back((first + i) * ticks.step);
  return ticks;
}

std::string tick_label(double value, double step) {
  constexpr double hair = 1e-9;
  const int decimals = std::max(0, static_cast<int>(std::ceil(-std::log10(step) - hair)));
  return fixed(value, decimals);
}

std::string short_number(double value, int digits) {
  if (!std::isfinite(value)) return "not finite";
  if (value == 0.0) return "0";
  const int before = static_cast<int>(std::floor(std::log10(std::abs(value)))) + 1;
  std::string text = fixed(value, std::max(0, digits - before));
  if (text.find('.') == std::string::npos) return text;
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  return text;
}

}  // namespace acus::study
