// Curves as pictures and tables need them: values at a place, fewer points that look the same, circles.
#pragma once

#include <optional>
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

struct Circle {
  double curvature = 0.0;
  double residual = 0.0;  // root mean square distance of the points from it
};

// Through points of a curve, least squares of x^2 + y^2 = a x + b y + c (Kasa 1976); none through fewer than
// three points or a straight line.
std::optional<Circle> circle_through(std::span<const Point2> points);

}  // namespace acus::study
