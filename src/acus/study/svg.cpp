#include "acus/study/svg.h"

#include <cstdio>

#include "acus/study/markup.h"

namespace acus::study {
namespace {

std::string pair(const Point2& p) { return joined({pixels(p[0]), " ", pixels(p[1])}); }

std::string path_data(std::span<const Point2> points) {
  std::string d = "M";
  for (const Point2& p : points) d += joined({d.size() > 1 ? " " : "", pair(p)});
  return d;
}

const char* word(Anchor anchor) {
  switch (anchor) {
    case Anchor::start:
      return "start";
    case Anchor::middle:
      return "middle";
    case Anchor::end:
      return "end";
  }
  return "start";
}

}  // namespace

std::string pixels(double value) {
  char text[48];
  std::snprintf(text, sizeof text, "%.2f", value);
  std::string out = text;
  out.erase(out.find_last_not_of('0') + 1);
  if (out.back() == '.') out.pop_back();
  return out == "-0" ? "0" : out;
}

Svg::Svg(double width, double height, std::string title, std::string description)
    : width_(width), height_(height), title_(std::move(title)), description_(std::move(description)) {}

void Svg::open(std::string_view name, std::string_view classes) {
  body_ += joined({"<", name, " class=\"", classes, "\""});
}

void Svg::attribute(std::string_view name, double value) { attribute(name, pixels(value)); }

void Svg::attribute(std::string_view name, std::string_view value) {
  body_ += joined({" ", name, "=\"", value, "\""});
}

// A tooltip is the title that browsers show on hover.
void Svg::close(std::string_view name, std::string_view tooltip) {
  body_ += tooltip.empty() ? "/>\n" : joined({"><title>", escaped(tooltip), "</title></", name, ">\n"});
}

void Svg::line(Point2 from, Point2 to, std::string_view classes) {
  open("line", classes);
  attribute("x1", from[0]);
  attribute("y1", from[1]);
  attribute("x2", to[0]);
  attribute("y2", to[1]);
  close("line", {});
}

void Svg::rect(Point2 corner, double width, double height, std::string_view classes) {
  open("rect", classes);
  attribute("x", corner[0]);
  attribute("y", corner[1]);
  attribute("width", width);
  attribute("height", height);
  close("rect", {});
}

void Svg::circle(Point2 centre, double radius, std::string_view classes, std::string_view tooltip) {
  open("circle", classes);
  attribute("cx", centre[0]);
  attribute("cy", centre[1]);
  attribute("r", radius);
  close("circle", tooltip);
}

void Svg::path(std::span<const Point2> points, bool closed, std::string_view classes,
               std::string_view tooltip) {
  if (points.empty()) return;
  open("path", classes);
  attribute("d", joined({path_data(points), closed ? "Z" : ""}));
  close("path", tooltip);
}

void Svg::wide_path(std::span<const Point2> points, double width, std::string_view classes) {
  if (points.empty()) return;
  open("path", classes);
  attribute("stroke-width", width);
  attribute("d", path_data(points));
  close("path", {});
}

void Svg::polygons(std::span<const CutPolygon> polygons, std::string_view classes) {
  if (polygons.empty()) return;
  std::string d;
  for (const CutPolygon& polygon : polygons) {
    for (std::size_t i = 0; i < static_cast<std::size_t>(polygon.corners); ++i)
      d += joined({i == 0 ? "M" : " ", pair(polygon.corner[i])});
    d += "Z";
  }
  open("path", classes);
  attribute("d", d);
  close("path", {});
}

void Svg::pieces(std::span<const std::array<Point2, 2>> pieces, std::string_view classes) {
  if (pieces.empty()) return;
  std::string d;
  for (const auto& piece : pieces) d += joined({"M", pair(piece[0]), " ", pair(piece[1])});
  open("path", classes);
  attribute("d", d);
  close("path", {});
}

void Svg::text(Point2 at, Anchor anchor, std::string_view classes, std::string_view words) {
  open("text", classes);
  attribute("x", at[0]);
  attribute("y", at[1]);
  attribute("text-anchor", word(anchor));
  body_ += joined({">", escaped(words), "</text>\n"});
}

void Svg::text_upwards(Point2 at, std::string_view classes, std::string_view words) {
  open("text", classes);
  attribute("transform", joined({"translate(", pair(at), ") rotate(-90)"}));
  attribute("text-anchor", "middle");
  body_ += joined({">", escaped(words), "</text>\n"});
}

void Svg::begin_clip(Point2 corner, double width, double height) {
  // A nested picture clips by itself and needs no name, which would have to be unique in a page.
  open("svg", "clip");
  attribute("x", corner[0]);
  attribute("y", corner[1]);
  attribute("width", width);
  attribute("height", height);
  attribute("viewBox", joined({pair(corner), " ", pixels(width), " ", pixels(height)}));
  body_ += ">\n";
}

void Svg::end_clip() { body_ += "</svg>\n"; }

std::string Svg::element(std::string_view attributes, std::string_view head) const {
  const std::string label = escaped(title_) + ". " + escaped(description_);
  return joined({"<svg class=\"picture\" role=\"img\" viewBox=\"0 0 ", pixels(width_), " ", pixels(height_),
                 "\" aria-label=\"", label, "\"", attributes, ">\n", head, body_, "</svg>\n"});
}

std::string Svg::inline_element() const {
  constexpr double most_enlarged = 1.1;
  return element(joined({" style=\"max-width:", pixels(most_enlarged * width_), "px\""}), "");
}

std::string Svg::document() const {
  const std::string w = pixels(width_), h = pixels(height_);
  const std::string size =
      joined({" xmlns=\"http://www.w3.org/2000/svg\" width=\"", w, "\" height=\"", h, "\""});
  const std::string head =
      joined({"<title>", escaped(title_), "</title>\n<style>\n", picture_style(),
              "</style>\n<rect class=\"paper\" x=\"0\" y=\"0\" width=\"", w, "\" height=\"", h, "\"/>\n"});
  return element(size, head);
}

}  // namespace acus::study
