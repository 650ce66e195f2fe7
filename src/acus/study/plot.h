// Plots: curves, event marks, levels and stacked areas, as one Svg each.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "acus/study/svg.h"

namespace acus::study {

enum class MarkShape { circle, triangle_down, diamond, triangle_up, square, cross };

struct Curve {
  std::string label;           // written at its end; empty for none
  int style = 0;               // 0 to 7: colour and dash
  std::vector<Point2> points;  // in the units of the axes; x need not increase
  enum class Dash { of_style, solid, dashed } dash = Dash::of_style;
};

struct Mark {
  Point2 at{};
  MarkShape shape = MarkShape::circle;
  int style = 0;
  std::string tooltip;
};

// A tinted rectangle about `at`, with a mark in it and, below the mark, a few letters.
struct Cell {
  Mark mark;
  Point2 size{};  // in the units of the axes
  std::string words;
};

// A horizontal line across the plot.
struct Level {
  double y = 0.0;
  int style = 6;
  std::string label;
};

struct KeyEntry {
  MarkShape shape = MarkShape::circle;
  std::string words;
  std::string classes = "neutral";  // its colour
};

struct Plot {
  std::string title;
  std::string description;  // for those who cannot see it
  std::string x_label, y_label;
  std::vector<Curve> curves;
  std::vector<Mark> marks;
  std::vector<Cell> cells;  // tints under everything else; the limits of the axes are to be given
  std::vector<Level> levels;
  std::vector<KeyEntry> key;  // what the shapes of the marks mean
  std::optional<Point2> x_limits, y_limits;
  bool equal_scales = false;  // one unit is as long across as up
};

Svg drawn(const Plot& plot);

// Bands stacked upon each other: negative values go below zero.
struct Band {
  std::string label;
  int style = 0;
  std::vector<double> values;
};
struct StackPlot {
  std::string title, description, x_label, y_label;
  std::vector<double> x;    // increasing
  std::vector<Band> bands;  // each as long as x, non-negative but for rounding
  Curve total;              // drawn above the bands
};

Svg drawn(const StackPlot& plot);

}  // namespace acus::study
