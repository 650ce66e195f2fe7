#include "acus/study/plot_frame.h"

#include <algorithm>
#include <cmath>

#include "acus/study/axis_ticks.h"

namespace acus::study {
namespace {

constexpr double px_per_tick_x = 75.0;
constexpr double px_per_tick_y = 48.0;
constexpr double label_height = 14.5;  // px from one line of words to the next

// Limits about `value`, so that it stands in the middle.
Limits around(double value) {
  const double half = 0.5 * std::max(std::abs(value), 1.0);
  return {value - half, value + half};
}

Limits apart(Limits limits) { return has_span(limits.low, limits.high) ? limits : around(limits.low); }

}  // namespace

PlotFrame::PlotFrame(Point2 corner, double width, double height, Limits x, Limits y)
    : corner_(corner), width_(width), height_(height), x_limits_(apart(x)), y_limits_(apart(y)) {}

double PlotFrame::x(double value) const {
  return corner_[0] + width_ * (value - x_limits_.low) / (x_limits_.high - x_limits_.low);
}

double PlotFrame::y(double value) const {
  return corner_[1] + height_ * (y_limits_.high - value) / (y_limits_.high - y_limits_.low);
}

void PlotFrame::draw_axes(Svg& svg, const std::string& x_label, const std::string& y_label) const {
  const Ticks xs =
      axis_ticks(x_limits_.low, x_limits_.high, std::max(2, static_cast<int>(width_ / px_per_tick_x)));
  const Ticks ys =
      axis_ticks(y_limits_.low, y_limits_.high, std::max(2, static_cast<int>(height_ / px_per_tick_y)));
  for (double v : ys.at) {
    svg.line({left(), y(v)}, {right(), y(v)}, "grid");
    svg.text({left() - 7.0, y(v) + 4.0}, Anchor::end, "soft", tick_label(v, ys.step));
  }
  for (double v : xs.at) {
    svg.line({x(v), bottom()}, {x(v), bottom() + 5.0}, "axis");
    svg.text({x(v), bottom() + 19.0}, Anchor::middle, "soft", tick_label(v, xs.step));
  }
  const double floor = y_limits_.low < 0.0 && y_limits_.high > 0.0 ? y(0.0) : bottom();
  svg.line({left(), floor}, {right(), floor}, "axis");
  svg.line({left(), bottom()}, {left(), top()}, "axis");
  svg.text({(left() + right()) / 2.0, bottom() + 39.0}, Anchor::middle, "", x_label);
  svg.text_upwards({left() - 44.0, (top() + bottom()) / 2.0}, "", y_label);
}

void draw_side_labels(Svg& svg, std::vector<SideLabel> labels, double x, Limits y) {
  std::stable_sort(labels.begin(), labels.end(),
                   [](const SideLabel& a, const SideLabel& b) { return a.anchor[1] < b.anchor[1]; });
  std::vector<double> at;
  for (const SideLabel& label : labels) at.push_back(std::clamp(label.anchor[1], y.low, y.high));
  // Push down from the top, then up from the bottom: order is kept and nothing leaves [y.low, y.high].
  for (std::size_t i = 1; i < at.size(); ++i) at[i] = std::max(at[i], at[i - 1] + label_height);
  double limit = y.high;
  for (std::size_t i = at.size(); i-- > 0; limit = at[i] - label_height) at[i] = std::min(at[i], limit);
  for (std::size_t i = 0; i < labels.size(); ++i) {
    const std::string style = std::to_string(labels[i].style);
    if (std::abs(at[i] - labels[i].anchor[1]) > 2.0 || x - labels[i].anchor[0] > 12.0)
      svg.line({labels[i].anchor[0] + 3.0, labels[i].anchor[1]}, {x - 3.0, at[i]}, "leader s" + style);
    svg.text({x, at[i] + 4.0}, Anchor::start, (labels[i].strong ? "strong f" : "small f") + style,
             labels[i].words);
  }
}

Limits roomy(const std::vector<double>& values) {
  double low = HUGE_VAL, high = -HUGE_VAL;
  for (double value : values) {
    if (std::isfinite(value)) low = std::min(low, value), high = std::max(high, value);
  }
  if (low > high) return {};
  constexpr double air = 0.04;
  if (!has_span(low, high)) return around(low);
  const double span = high - low;
  Limits out{low - air * span, high + air * span};
  if (low >= 0.0 && low < 0.4 * high) out.low = 0.0;
  if (low < 0.0 && low > -1e-6 * span) out.low = 0.0;  // rounding around zero is zero
  return out;
}

}  // namespace acus::study
