// Durations counted as they come, eight bins to an octave from 100 ns to 27 s: any quantile to 5 %, without
// an allocation.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace acus::haptics {

class DurationHistogram {
 public:
  void add(double seconds) noexcept {
    ++counts_[bin_of(seconds)];
    ++count_;
    sum_ += seconds;
    longest_ = std::max(longest_, seconds);
  }
  long count() const { return count_; }
  double longest() const { return longest_; }                                            // s
  double mean() const { return count_ > 0 ? sum_ / static_cast<double>(count_) : 0.0; }  // s
  // How many were longer than that, to the width of a bin.
  long longer_than(double seconds) const {
    long longer = 0;
    for (std::size_t i = bin_of(seconds) + 1; i < bins; ++i) longer += counts_[i];
    return longer;
  }
  // The duration that a share `q` in [0, 1] of them does not exceed, s.
  double quantile(double q) const {
    const auto wanted = static_cast<long>(std::ceil(q * static_cast<double>(count_)));
    long below = 0;
    for (std::size_t i = 0; i < bins; ++i)
      if ((below += counts_[i]) >= wanted && below > 0)
        return std::min(shortest * std::exp2((static_cast<double>(i) + 1.0) / per_octave), longest_);
    return 0.0;
  }

 private:
  static constexpr std::size_t bins = 224;
  static constexpr double per_octave = 8.0, shortest = 100e-9;  // s

  static std::size_t bin_of(double seconds) noexcept {
    if (!(seconds > shortest)) return 0;
    return std::min(static_cast<std::size_t>(per_octave * std::log2(seconds / shortest)), bins - 1);
  }

  std::array<long, bins> counts_{};
  long count_ = 0;
  double sum_ = 0.0, longest_ = 0.0;
};

}  // namespace acus::haptics
