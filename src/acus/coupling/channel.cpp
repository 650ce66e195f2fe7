#include "acus/coupling/channel.h"

#include <algorithm>
#include <numbers>

namespace acus::coupling {

double sleeve_stiffness(double shear_modulus) { return 2.0 * std::numbers::pi * shear_modulus; }

double cover(ChannelState& state, const Channel& channel, double depth, double inserted) {
  const double stretch = depth > 0.0 ? inserted / depth : 0.0;
  double released = 0.0;
  for (int cell = 0; cell < channel.cells(); ++cell) {
    double& length = state.length[cell];
    double& elongation = state.elongation[cell];
    const double now = stretch * std::clamp(depth - cell * channel_cell, 0.0, channel_cell);
    if (now == length) continue;
    const double stored = 0.5 * channel.stiffness[cell] * length * elongation * elongation;
    if (now > length) elongation *= length / now;
    if (now == 0.0) elongation = 0.0;
    length = now;
    released += stored - 0.5 * channel.stiffness[cell] * length * elongation * elongation;
  }
  return released;
}

Slider slider_of(const Channel& channel, const ChannelState& state, int cell) {
  const double limit = channel.friction * state.length[cell];
  return {channel.stiffness[cell] * state.length[cell], state.elongation[cell], -limit, limit, false};
}

}  // namespace acus::coupling
