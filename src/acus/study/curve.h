// Curves as pictures need them: values at a place, and fewer points that look the same.
#pragma once

#include <span>
#include <vector>

#include "acus/study/section.h"

namespace acus::study {

// The points that keep the polyline within `tolerance` of the given one (Douglas and Peucker 1973); ends are
// kept.
std::vector<Point2> simplified(std::span<const Point2> points, double tolerance);

// y at x on straight lines between the samples (x not decreasing, same sizes, not empty); the end values
// outside.
double value_at(std::span<const double> xs, std::span<const double> ys, double x);

}  // namespace acus::study
