// The frame of a plot: axes, ticks and grid, and where values fall in it.
#pragma once

#include <string>
#include <vector>

#include "acus/study/svg.h"

namespace acus::study {

struct Limits {
  double low = 0.0;
  double high = 1.0;
};

class PlotFrame {
 public:
  // The rectangle of the picture, in pixels, that shows x times y; limits without a span are moved apart.
  PlotFrame(Point2 corner, double width, double height, Limits x, Limits y);

  double x(double value) const;
  double y(double value) const;
  Point2 at(const Point2& value) const { return {x(value[0]), y(value[1])}; }

  void draw_axes(Svg& svg, const std::string& x_label, const std::string& y_label) const;

  double left() const { return corner_[0]; }
  double right() const { return corner_[0] + width_; }
  double top() const { return corner_[1]; }
  double bottom() const { return corner_[1] + height_; }

 private:
  Point2 corner_;
  double width_, height_;
  Limits x_limits_, y_limits_;
};

// Words in the right margin beside the y they belong to, moved apart so that none covers another.
struct SideLabel {
  Point2 anchor{};  // px, what it belongs to
  std::string words;
  int style = 0;  // of the series it names
  bool strong = false;
};
void draw_side_labels(Svg& svg, std::vector<SideLabel> labels, double x, Limits y);

// Limits that hold every finite value, a little air, and zero when it is near.
Limits roomy(const std::vector<double>& values);

}  // namespace acus::study
