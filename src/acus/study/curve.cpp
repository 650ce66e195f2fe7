#include "acus/study/curve.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "acus/base/vec.h"

namespace acus::study {
namespace {

double distance_to_piece(const Point2& p, const Point2& a, const Point2& b) {
  const double dx = b[0] - a[0], dy = b[1] - a[1];
  const double length2 = dx * dx + dy * dy;
  const double along =
      length2 > 0.0 ? std::clamp(((p[0] - a[0]) * dx + (p[1] - a[1]) * dy) / length2, 0.0, 1.0) : 0.0;
  return std::hypot(p[0] - a[0] - along * dx, p[1] - a[1] - along * dy);
}

}  // namespace

std::vector<Point2> simplified(std::span<const Point2> points, double tolerance) {
  if (points.size() < 3) return {points.begin(), points.end()};
  std::vector<char> kept(points.size(), 0);
  kept.front() = kept.back() = 1;
  std::vector<std::pair<std::size_t, std::size_t>> open{{0, points.size() - 1}};
  while (!open.empty()) {
    const auto [first, last] = open.back();
    open.pop_back();
    double furthest = tolerance;
    std::size_t split = first;
    for (std::size_t i = first + 1; i < last; ++i) {
      const double d = distance_to_piece(points[i], points[first], points[last]);
      if (d > furthest) furthest = d, split = i;
    }
    if (split == first) continue;
    kept[split] = 1;
    open.push_back({first, split});
    open.push_back({split, last});
  }
  std::vector<Point2> out;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (kept[i]) out.push_back(points[i]);
  }
  return out;
}

double value_at(std::span<const double> xs, std::span<const double> ys, double x) {
  assert(!xs.empty() && xs.size() == ys.size() && std::is_sorted(xs.begin(), xs.end()));
  const auto after = static_cast<std::size_t>(std::upper_bound(xs.begin(), xs.end(), x) - xs.begin());
  if (after == 0) return ys.front();
  if (after == xs.size()) return ys.back();
  const double share = (x - xs[after - 1]) / (xs[after] - xs[after - 1]);
  return ys[after - 1] + share * (ys[after] - ys[after - 1]);
}

std::optional<Circle> circle_through(std::span<const Point2> points) {
  if (points.size() < 3) return std::nullopt;
  // About the first point and by the distance of the last, so that the three sums are of one size.
  const Point2 origin = points.front();
  const double size = std::hypot(points.back()[0] - origin[0], points.back()[1] - origin[1]);
  if (!(size > 0.0)) return std::nullopt;
  Mat3 normal = Mat3::Zero();
  Vec3 right = Vec3::Zero();
  const auto row_of = [&](const Point2& p) {
    return Vec3((p[0] - origin[0]) / size, (p[1] - origin[1]) / size, 1.0);
  };
  for (const Point2& p : points) {
    const Vec3 row = row_of(p);
    normal += row * row.transpose();
    right += row.head<2>().squaredNorm() * row;
  }
  constexpr double straight = 1e-15;  // of the determinant of points that lie on a line
  const double count = static_cast<double>(points.size());
  if (!(normal.determinant() > straight * count * count * count)) return std::nullopt;
  const Vec3 fitted = normal.inverse() * right;
  const double x = 0.5 * fitted.x(), y = 0.5 * fitted.y();
  const double radius = std::sqrt(fitted.z() + x * x + y * y);
  double sum = 0.0;
  for (const Point2& p : points) {
    const Vec3 row = row_of(p);
    sum += std::pow(std::hypot(row.x() - x, row.y() - y) - radius, 2);
  }
  return Circle{1.0 / (radius * size), size * std::sqrt(sum / count)};
}

}  // namespace acus::study
