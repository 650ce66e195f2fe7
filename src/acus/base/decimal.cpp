#include "acus/base/decimal.h"

#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>

namespace acus {

std::string decimal_text(double value) {
  constexpr int always_exact_back = 17;  // significant digits that tell any two doubles apart
  std::array<char, 32> text{};
  // Fifteen digits read back for most numbers that people write; the rest need one or two more.
  for (int digits = 15; digits <= always_exact_back; ++digits) {
    std::snprintf(text.data(), text.size(), "%.*g", digits, value);
    if (!std::isfinite(value) || std::strtod(text.data(), nullptr) == value) break;
  }
  return text.data();
}

double times_power_of_ten(double value, int power) {
  if (!std::isfinite(value)) return value;
  std::string text = decimal_text(value);
  const auto exponent_mark = text.find('e');
  if (exponent_mark != std::string::npos) {
    power += std::atoi(text.c_str() + exponent_mark + 1);
    text.resize(exponent_mark);
  }
  return std::strtod((text + "e" + std::to_string(power)).c_str(), nullptr);
}

}  // namespace acus
