// Clocks, and what is said of many samples.
#pragma once

#include <cstdint>
#include <vector>

namespace acus::bench {

// Nanoseconds; of the calling thread, so that other work on the machine does not count, and of the world.
std::int64_t processor_clock();
std::int64_t wall_clock();
// By which a step is timed that so many threads share: several wait for each other, and do not count each
// other's.
inline auto clock_for(int threads) { return threads == 1 ? processor_clock : wall_clock; }
// us, exact to the nanosecond
inline double us_between(std::int64_t from, std::int64_t to) {
  return static_cast<double>(to - from) / 1000.0;
}

// The smallest of them that a share of at least `share` does not exceed; 0.5: the median. `values` not empty.
double quantile(std::vector<double> values, double share);
double median(const std::vector<double>& values);
double sum(const std::vector<double>& values);
double mean(const std::vector<double>& values);

}  // namespace acus::bench
