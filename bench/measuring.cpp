#include "measuring.h"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <numeric>

namespace acus::bench {
namespace {

std::int64_t now(clockid_t clock) {
  constexpr std::int64_t second = 1'000'000'000;
  timespec t;
  clock_gettime(clock, &t);
  return second * t.tv_sec + t.tv_nsec;
}

}  // namespace

std::int64_t processor_clock() { return now(CLOCK_THREAD_CPUTIME_ID); }
std::int64_t wall_clock() { return now(CLOCK_MONOTONIC); }

double quantile(std::vector<double> values, double share) {
  const double rank = std::ceil(share * static_cast<double>(values.size()));
  const auto at = values.begin() + std::max(static_cast<std::ptrdiff_t>(rank) - 1, std::ptrdiff_t{0});
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

double median(const std::vector<double>& values) { return quantile(values, 0.5); }
double sum(const std::vector<double>& values) { return std::accumulate(values.begin(), values.end(), 0.0); }
double mean(const std::vector<double>& values) { return sum(values) / static_cast<double>(values.size()); }

}  // namespace acus::bench
