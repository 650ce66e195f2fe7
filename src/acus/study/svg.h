// Svg: a picture written element by element, in the user's light or dark, without any library.
// Colours are classes; their one home is picture_style(), so that a page can hold many pictures.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "acus/study/section.h"

namespace acus::study {

// CSS: ink, grid, the colours and dashes of series 0 to 7 (s0..s7), shades 0 to 8 (v0..v8), light and dark,
// AA contrast.
std::string picture_style();

enum class Anchor { start, middle, end };

// Coordinates are pixels at the picture's own size; y goes down.
class Svg {
 public:
  // `description` is what a person who cannot see the picture is told.
  Svg(double width, double height, std::string title, std::string description);

  void line(Point2 from, Point2 to, std::string_view classes);
  void rect(Point2 corner, double width, double height, std::string_view classes);
  void circle(Point2 centre, double radius, std::string_view classes, std::string_view tooltip = {});
  // A path of straight pieces; `closed` fills it.
  void path(std::span<const Point2> points, bool closed, std::string_view classes,
            std::string_view tooltip = {});
  // An open path `width` pixels thick.
  void wide_path(std::span<const Point2> points, double width, std::string_view classes);
  // Many closed polygons of one class in one element.
  void polygons(std::span<const CutPolygon> polygons, std::string_view classes);
  void pieces(std::span<const std::array<Point2, 2>> pieces, std::string_view classes);
  void text(Point2 at, Anchor anchor, std::string_view classes, std::string_view words);
  void text_upwards(Point2 at, std::string_view classes, std::string_view words);
  // Everything between is drawn only inside the rectangle.
  void begin_clip(Point2 corner, double width, double height);
  void end_clip();

  double width() const { return width_; }
  double height() const { return height_; }
  // For a page that carries picture_style() itself.
  std::string inline_element() const;
  // For a file of its own.
  std::string document() const;

 private:
  void open(std::string_view name, std::string_view classes);
  void attribute(std::string_view name, double value);
  void attribute(std::string_view name, std::string_view value);
  void close(std::string_view name, std::string_view tooltip);
  std::string element(std::string_view attributes, std::string_view head) const;

  double width_, height_;
  std::string title_, description_, body_;
};

// A number as pictures write it: two decimals, no trailing zeros.
std::string pixels(double value);

}  // namespace acus::study
