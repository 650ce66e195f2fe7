#include "acus/coupling/guide.h"

#include <algorithm>
#include <cmath>

namespace acus::coupling {

Guide build_guide(const Vec3& begin, const Vec3& direction, double length, double spacing) {
  Guide guide;
  if (length <= 0.0) return guide;
  const int parts = std::max(1, static_cast<int>(std::ceil(length / spacing)));
  for (int i = 0; i <= parts; ++i) {
    guide.point.push_back(begin + (i * length / parts) * direction);
    guide.length.push_back(length / parts * (i == 0 || i == parts ? 0.5 : 1.0));
  }
  return guide;
}

Slider slider_of(const Guide& guide, int point, double elongation) {
  if (guide.friction == 0.0) return {};
  const double length = guide.length[point], limit = guide.friction * length;
  return {guide.stiffness * length, elongation, -limit, limit};
}

}  // namespace acus::coupling
