#include "acus/sim/felt.h"

#include <algorithm>
#include <cmath>

namespace acus {
namespace {

// Chosen: half a swing of the tremor, so that it is not taken for news and a snap of a tenth of a second is.
constexpr double sense_time = 0.05;  // s
// Chosen: the stretch of travel by which a hand knows how stiff a thing is. A stiffness that changes by 100
// N/m (tissue that is met, a needle that gives way) then surprises by up to 100 N/m * 2.5 mm / e = 0.09 N. A
// hand that was surprised attends to what there is now, and knows it five times sooner.
constexpr double memory = 2.5e-3, attentive_memory = 0.5e-3;  // m
// A force is told from another that differs by 7 % (Pang, Tan and Durlach, Perception & Psychophysics 49:531,
// 1991). Chosen below 0.7 N, where Weber's law ends: what a hand can just feel while it shakes.
constexpr double noticed_share = 0.07;
constexpr double least_noticed = 0.05;  // N

}  // namespace

Felt felt_after(Felt felt, double travel, double force, double time_step, bool attentive) {
  const double stretch = attentive ? attentive_memory : memory;
  const double share = time_step / (sense_time + time_step);
  const double way = share * (travel - felt.travel);
  felt.travel += way;
  felt.force += share * (force - felt.force);
  // A critically damped observer over the way, not over time: who stands still learns nothing.
  felt.expected += felt.slope * way;
  const double missed = felt.force - felt.expected, learned = std::min(std::abs(way) / stretch, 0.5);
  felt.expected += 2.0 * learned * missed;
  felt.slope += std::copysign(learned, way) * missed / stretch;
  felt.slope = std::max(felt.slope, 0.0);  // nothing is expected to pull a hand on that presses it
  return felt;
}

bool surprising(const Felt& felt) {
  const double noticed = std::max(least_noticed, noticed_share * std::abs(felt.expected));
  return std::abs(felt.force - felt.expected) > noticed;
}

}  // namespace acus
