#include "acus/study/curve.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

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

}  // namespace acus::study
