#include "acus/study/expansion.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <random>

#include "acus/study/text_hash.h"

namespace acus::study {
namespace {

// Evenly in [0, 1), from the 53 high bits that a double can hold.
double unit_draw(std::mt19937_64& bits) { return static_cast<double>(bits() >> 11) * 0x1.0p-53; }

std::string drawn_value(const RandomRange& range, std::mt19937_64& bits) {
  const double u = unit_draw(bits);
  char text[48];
  if (range.whole_numbers) {
    std::snprintf(text, sizeof text, "%.0f", range.low + std::floor(u * (range.high - range.low + 1.0)));
  } else {
    // Six digits keep tables readable; rounding must not leave the range.
    std::snprintf(text, sizeof text, "%.6g", range.low + u * (range.high - range.low));
    const double rounded = std::strtod(text, nullptr);
    if (rounded < range.low || rounded > range.high)
      std::snprintf(text, sizeof text, "%.17g", rounded < range.low ? range.low : range.high);
  }
  return text;
}

}  // namespace

std::string name_part(const Choice& choice) {
  const bool word = choice.value.starts_with('"') || choice.value.starts_with('\'');
  std::string part;
  if (!word) part.append(choice.key, choice.key.find_last_of('.') + 1).append("_");
  for (char c : choice.value) {
    if (c == '"' || c == '\'') continue;
    const bool plain = std::isalnum(static_cast<unsigned char>(c)) || c == '.' || c == '-' || c == '+';
    part.push_back(plain ? c : '_');
  }
  return part;
}

std::string fitted_name(std::string name, std::size_t most) {
  if (name.starts_with('.')) name.front() = '_';
  if (name.size() <= most) return name;
  const std::string hash = hex(hash_of_text(name));
  name.resize(most - hash.size() - 1);
  return name.append("-").append(hash);
}

std::vector<Case> grid(std::span<const Axis> axes) {
  std::vector<Case> cases(1);
  for (const Axis& axis : axes) {
    std::vector<Case> finer;
    for (const Case& one : cases) {
      for (const std::string& value : axis.values) {
        Case next = one;
        next.choices.push_back({axis.key, value});
        if (!next.name.empty()) next.name.push_back('-');
        next.name.append(name_part(next.choices.back()));
        finer.push_back(std::move(next));
      }
    }
    cases = std::move(finer);
  }
  return cases;
}

std::vector<Case> combined(std::span<const Case> outer, std::span<const Case> inner) {
  if (outer.empty()) return {inner.begin(), inner.end()};
  std::vector<Case> cases;
  for (const Case& first : outer) {
    for (const Case& one : inner) {
      Case next = first;
      if (!one.name.empty()) next.name.append("-").append(one.name);
      next.choices.insert(next.choices.end(), one.choices.begin(), one.choices.end());
      cases.push_back(std::move(next));
    }
  }
  return cases;
}

std::vector<Case> random_sample(std::span<const RandomRange> ranges, int count, std::uint64_t seed) {
  std::mt19937_64 bits(seed);
  std::vector<Case> cases;
  for (int i = 0; i < count; ++i) {
    char name[32];
    std::snprintf(name, sizeof name, "sample-%04d", i + 1);
    Case one{name, {}};
    for (const RandomRange& range : ranges) one.choices.push_back({range.key, drawn_value(range, bits)});
    cases.push_back(std::move(one));
  }
  return cases;
}

}  // namespace acus::study
