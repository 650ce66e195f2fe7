// Expansion: from axes, lists and random ranges to the list of runs, always in the same order.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace acus::study {

// One scene key and the value it gets, as TOML text: {"needle.length_mm", "150"}, {"needle.support",
// "\"pinned_pinned\""}.
struct Choice {
  std::string key;
  std::string value;
  bool operator==(const Choice&) const = default;
};

// One run of a study: its name is also its folder's.
struct Case {
  std::string name;
  std::vector<Choice> choices;
};

struct Axis {
  std::string key;
  std::vector<std::string> values;  // TOML text
};

// Every combination; the first axis varies slowest. No axes give one case without a name or a choice.
std::vector<Case> grid(std::span<const Axis> axes);

// Each of `outer` with each of `inner` laid over it, names joined; the inner ones alone when there are no
// outer ones.
std::vector<Case> combined(std::span<const Case> outer, std::span<const Case> inner);

struct RandomRange {
  std::string key;
  double low = 0.0, high = 0.0;
  bool whole_numbers = false;
};

// `count` cases, each value drawn evenly from its range. The same seed gives the same cases on every machine
// (std::mt19937_64, whose sequence the C++ standard fixes).
std::vector<Case> random_sample(std::span<const RandomRange> ranges, int count, std::uint64_t seed);

// What a choice adds to the name of its case: the value for words, key and value for numbers. Letters, digits
// and - + _ . only.
std::string name_part(const Choice& choice);

// `name` as the name of a folder or a part of one: at most `most` letters, the last of a longer one being a
// hash of the whole, and no dot at its beginning. `most` is at least 20.
std::string fitted_name(std::string name, std::size_t most);

}  // namespace acus::study
