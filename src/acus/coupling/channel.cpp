#include "acus/coupling/channel.h"

#include <algorithm>
#include <numbers>

namespace acus::coupling {

double sleeve_stiffness(double shear_modulus) { return 2.0 * std::numbers::pi * shear_modulus; }

double cover(Channel& c, double depth, double inserted) {
  const double stretch = depth > 0.0 ? inserted / depth : 0.0;
  double released = 0.0;
  for (std::size_t cell = 0; cell < c.length.size(); ++cell) {
    const double before = c.length[cell];
    const double now =
        stretch * std::clamp(depth - static_cast<double>(cell) * channel_cell, 0.0, channel_cell);
    if (now == before) continue;
    const double stored = 0.5 * c.stiffness * before * c.elongation[cell] * c.elongation[cell];
    if (now > before) c.elongation[cell] *= before / now;
    if (now == 0.0) c.elongation[cell] = 0.0;
    c.length[cell] = now;
    released += stored - 0.5 * c.stiffness * now * c.elongation[cell] * c.elongation[cell];
  }
  return released;
}

}  // namespace acus::coupling
