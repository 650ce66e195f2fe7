#include "acus/study/plot.h"

#include <algorithm>
#include <cmath>

#include "acus/study/curve.h"
#include "acus/study/plot_frame.h"

namespace acus::study {
namespace {

constexpr double picture_width = 600.0, picture_height = 400.0;
constexpr double margin_left = 62.0, margin_right = 150.0, margin_bottom = 50.0, margin_top = 34.0;
constexpr double key_height = 22.0;
constexpr double invisible = 0.25;  // px: detail that no eye sees is left out
constexpr double mark_radius = 5.0;

void draw_mark(Svg& svg, Point2 at, MarkShape shape, const std::string& classes, const std::string& tooltip) {
  const double r = mark_radius, x = at[0], y = at[1];
  std::vector<Point2> corners;
  switch (shape) {
    case MarkShape::circle:
      return svg.circle(at, 0.9 * r, classes, tooltip);
    case MarkShape::triangle_down:
      corners = {{x - r, y - 0.7 * r}, {x + r, y - 0.7 * r}, {x, y + r}};
      break;
    case MarkShape::triangle_up:
      corners = {{x - r, y + 0.7 * r}, {x + r, y + 0.7 * r}, {x, y - r}};
      break;
    case MarkShape::diamond:
      corners = {{x, y - 1.2 * r}, {x + r, y}, {x, y + 1.2 * r}, {x - r, y}};
      break;
    case MarkShape::square:
      corners = {{x - 0.8 * r, y - 0.8 * r},
                 {x + 0.8 * r, y - 0.8 * r},
                 {x + 0.8 * r, y + 0.8 * r},
                 {x - 0.8 * r, y + 0.8 * r}};
      break;
    case MarkShape::cross: {
      const double a = 0.35 * r, b = 1.0 * r;
      corners = {{x - a, y - b}, {x + a, y - b}, {x + a, y - a}, {x + b, y - a},
                 {x + b, y + a}, {x + a, y + a}, {x + a, y + b}, {x - a, y + b},
                 {x - a, y + a}, {x - b, y + a}, {x - b, y - a}, {x - a, y - a}};
      break;
    }
  }
  svg.path(corners, true, classes, tooltip);
}

void draw_key(Svg& svg, const std::vector<KeyEntry>& key, Point2 at) {
  constexpr double px_per_letter = 6.6;
  for (const KeyEntry& entry : key) {
    draw_mark(svg, {at[0] + mark_radius, at[1]}, entry.shape, "mark " + entry.classes, {});
    svg.text({at[0] + 15.0, at[1] + 4.0}, Anchor::start, "soft small", entry.words);
    at[0] += 32.0 + px_per_letter * static_cast<double>(entry.words.size());
  }
}

std::string curve_classes(const Curve& curve) {
  const char* dash = curve.dash == Curve::Dash::solid    ? " solid"
                     : curve.dash == Curve::Dash::dashed ? " dashed"
                                                         : "";
  return "curve s" + std::to_string(curve.style) + dash;
}

struct Box {
  double left, right, top, bottom;  // px
};

Box box_of(const PlotFrame& frame, const Cell& cell) {
  constexpr double gap = 1.0;  // px around the tint, so that cells are told apart
  const Point2 at = cell.mark.at;
  return {frame.x(at[0] - cell.size[0] / 2.0) + gap, frame.x(at[0] + cell.size[0] / 2.0) - gap,
          frame.y(at[1] + cell.size[1] / 2.0) + gap, frame.y(at[1] - cell.size[1] / 2.0) - gap};
}

void draw_tint(Svg& svg, const Box& box, int style) {
  svg.rect({box.left, box.top}, box.right - box.left, box.bottom - box.top, "cell f" + std::to_string(style));
}

void draw_inside(Svg& svg, const Box& box, const Cell& cell) {
  constexpr double line = 14.0;  // px, of a mark or of words
  const Point2 middle{(box.left + box.right) / 2.0, (box.top + box.bottom) / 2.0};
  const double up = cell.words.empty() ? 0.0 : line / 2.0;
  draw_mark(svg, {middle[0], middle[1] - up}, cell.mark.shape, "mark f" + std::to_string(cell.mark.style),
            cell.mark.tooltip);
  if (!cell.words.empty())
    svg.text({middle[0], middle[1] + line}, Anchor::middle, "small legible", cell.words);
}

struct Ranges {
  Limits x, y;
};

Ranges ranges_of(const Plot& plot) {
  std::vector<double> xs, ys;
  for (const Curve& curve : plot.curves) {
    for (const Point2& p : curve.points) xs.push_back(p[0]), ys.push_back(p[1]);
  }
  for (const Mark& mark : plot.marks) xs.push_back(mark.at[0]), ys.push_back(mark.at[1]);
  for (const Level& level : plot.levels) ys.push_back(level.y);
  Ranges ranges{roomy(xs), roomy(ys)};
  if (plot.x_limits) ranges.x = {(*plot.x_limits)[0], (*plot.x_limits)[1]};
  if (plot.y_limits) ranges.y = {(*plot.y_limits)[0], (*plot.y_limits)[1]};
  return ranges;
}

// Widens the narrower range, about its middle, until both axes have one scale.
void equalise(Ranges& r, double width, double height) {
  const double scale = std::max((r.x.high - r.x.low) / width, (r.y.high - r.y.low) / height);
  const auto widen = [](Limits& l, double span) {
    const double middle = (l.low + l.high) / 2.0;
    l = {middle - span / 2.0, middle + span / 2.0};
  };
  widen(r.x, scale * width);
  widen(r.y, scale * height);
}

std::vector<Point2> in_pixels(const PlotFrame& frame, const std::vector<Point2>& points) {
  std::vector<Point2> px;
  px.reserve(points.size());
  for (const Point2& p : points) {
    if (std::isfinite(p[0]) && std::isfinite(p[1])) px.push_back(frame.at(p));
  }
  return simplified(px, invisible);
}

}  // namespace

Svg drawn(const Plot& plot) {
  Svg svg(picture_width, picture_height, plot.title, plot.description);
  svg.text({14.0, 20.0}, Anchor::start, "heading", plot.title);
  const double top = margin_top + (plot.key.empty() ? 0.0 : key_height);
  const double width = picture_width - margin_left - margin_right,
               height = picture_height - top - margin_bottom;
  Ranges ranges = ranges_of(plot);
  if (plot.equal_scales) equalise(ranges, width, height);
  const PlotFrame frame({margin_left, top}, width, height, ranges.x, ranges.y);
  frame.draw_axes(svg, plot.x_label, plot.y_label);
  draw_key(svg, plot.key, {margin_left, margin_top + 4.0});

  std::vector<SideLabel> labels;
  svg.begin_clip({frame.left(), frame.top() - 6.0}, width + 1.0, height + 7.0);
  for (const Cell& cell : plot.cells) draw_tint(svg, box_of(frame, cell), cell.mark.style);
  for (const Level& level : plot.levels)
    svg.line({frame.left(), frame.y(level.y)}, {frame.right(), frame.y(level.y)},
             "level s" + std::to_string(level.style));
  for (const Curve& curve : plot.curves)
    svg.path(in_pixels(frame, curve.points), false, curve_classes(curve), curve.label);
  svg.end_clip();
  for (const Cell& cell : plot.cells) draw_inside(svg, box_of(frame, cell), cell);
  for (const Mark& mark : plot.marks)
    draw_mark(svg, frame.at(mark.at), mark.shape, "mark f" + std::to_string(mark.style), mark.tooltip);
  for (const Level& level : plot.levels)
    labels.push_back({{frame.right(), frame.y(level.y)}, level.label, level.style, false});
  for (const Curve& curve : plot.curves) {
    if (curve.label.empty() || curve.points.empty()) continue;
    const Point2 end = frame.at(curve.points.back());
    // A curve that ends in the left half is named where it ends; a long leader would cross the others.
    if (end[0] < (frame.left() + frame.right()) / 2.0) {
      svg.text({end[0] + 8.0, end[1] + 12.0}, Anchor::start, "strong f" + std::to_string(curve.style),
               curve.label);
    } else {
      labels.push_back({end, curve.label, curve.style, true});
    }
  }
  draw_side_labels(svg, labels, frame.right() + 10.0, {frame.top(), frame.bottom()});
  return svg;
}

Svg drawn(const StackPlot& plot) {
  Svg svg(picture_width, picture_height, plot.title, plot.description);
  svg.text({14.0, 20.0}, Anchor::start, "heading", plot.title);
  const std::size_t n = plot.x.size();
  std::vector<double> extremes{0.0}, base(n, 0.0);
  std::vector<std::vector<double>> tops;
  for (const Band& band : plot.bands) {
    for (std::size_t i = 0; i < n; ++i) base[i] += band.values[i];
    tops.push_back(base);
    extremes.insert(extremes.end(), base.begin(), base.end());
  }
  for (const Point2& p : plot.total.points) extremes.push_back(p[1]);
  const double width = picture_width - margin_left - margin_right,
               height = picture_height - margin_top - margin_bottom;
  const PlotFrame frame({margin_left, margin_top}, width, height, {plot.x.front(), plot.x.back()},
                        roomy(extremes));
  frame.draw_axes(svg, plot.x_label, plot.y_label);

  std::vector<SideLabel> labels;
  std::vector<double> below(n, 0.0);
  for (std::size_t b = 0; b < plot.bands.size(); ++b) {
    std::vector<Point2> up, down;
    for (std::size_t i = 0; i < n; ++i) {
      up.push_back({plot.x[i], tops[b][i]});
      down.push_back({plot.x[n - 1 - i], below[n - 1 - i]});
    }
    std::vector<Point2> around = in_pixels(frame, up);
    for (const Point2& p : in_pixels(frame, down)) around.push_back(p);
    const std::string style = std::to_string(plot.bands[b].style);
    svg.path(around, true, "band f" + style, plot.bands[b].label);
    labels.push_back({{frame.right(), frame.y((tops[b][n - 1] + below[n - 1]) / 2.0)},
                      plot.bands[b].label,
                      plot.bands[b].style,
                      false});
    below = tops[b];
  }
  svg.path(in_pixels(frame, plot.total.points), false, "curve outline", plot.total.label);
  draw_side_labels(svg, labels, frame.right() + 10.0, {frame.top(), frame.bottom()});
  return svg;
}

}  // namespace acus::study
