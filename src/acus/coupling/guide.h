// What supports a needle outside of the tissue and does not move: a sleeve, a template, the fingers of a
// second hand. It holds the needle to a straight line across, and slides along it with dry friction.
#pragma once

#include <vector>

#include "acus/coupling/attachment.h"
#include "acus/coupling/slider.h"

namespace acus::coupling {

struct Guide {
  std::vector<Vec3> point;     // m, along the line, from the tissue on
  std::vector<double> length;  // m, of the guide that each stands for
  double stiffness = 0.0;      // N/m^2, per length
  double friction = 0.0;       // N/m, limit of the force per length
  Attachment nowhere;          // what it holds on to: nothing that gives

  int points() const { return static_cast<int>(point.size()); }
};

// From `begin` on, `length` [m] along `direction` (unit), its points at most `spacing` [m] apart, with one at
// each end. A length of 0 has none.
Guide build_guide(const Vec3& begin, const Vec3& direction, double length, double spacing);

// Along the needle, with `elongation` [m] of that point's spring.
Slider slider_of(const Guide& guide, int point, double elongation);

}  // namespace acus::coupling
