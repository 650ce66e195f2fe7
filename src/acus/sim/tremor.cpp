#include "acus/sim/tremor.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "acus/base/hash.h"
#include "acus/numeric/circular.h"

namespace acus {
namespace {

// The band in which the hands of healthy people shake (surgeons' while they hold an instrument: Riviere,
// Rader and Khosla, Proc. IEEE EMBS 1997), cut into five, one sine in the middle of each.
constexpr std::array frequencies{8.4, 9.2, 10.0, 10.8, 11.6};  // Hz
constexpr double grown_after = 0.5;                            // s, chosen: several swings
constexpr double turn = 2.0 * std::numbers::pi;

// In turns, 0 to 1.
double phase(int seed, int sine) {
  const std::array name{seed, sine};
  constexpr int spare = 64 - 53;  // bits of the hash that a double has no room for
  return static_cast<double>(hash_of(std::span<const int>(name)) >> spare) * 0x1p-53;
}

// Of each sine: n of them with amplitude A come to A sqrt(n / 2) rms.
double amplitude(double rms) { return rms * std::sqrt(2.0 / frequencies.size()); }

}  // namespace

double tremor(double rms, int seed, double time) {
  if (rms == 0.0) return 0.0;
  double sum = 0.0;
  for (int i = 0; i < static_cast<int>(frequencies.size()); ++i)
    sum += numeric::sin(turn * (frequencies[static_cast<std::size_t>(i)] * time + phase(seed, i)));
  return amplitude(rms) * std::min(time / grown_after, 1.0) * sum;
}

double furthest_tremor(double rms) { return amplitude(rms) * frequencies.size(); }

double fastest_tremor(double rms) {
  double sum = 1.0 / grown_after * frequencies.size();
  for (double frequency : frequencies) sum += turn * frequency;
  return amplitude(rms) * sum;
}

}  // namespace acus
