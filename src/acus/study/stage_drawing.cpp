#include "acus/study/stage_drawing.h"

#include <algorithm>
#include <cmath>

#include "acus/base/units.h"
#include "acus/study/axis_ticks.h"
#include "acus/study/curve.h"
#include "acus/study/markup.h"

namespace acus::study {
namespace {

using units::mm;
constexpr int shades = 9;  // v0..v8 of the style
constexpr double close_half_width = 17.0 * mm, close_above = 9.0 * mm, close_below = 21.0 * mm;
constexpr double panel_gap = 16.0, title_height = 34.0, caption_height = 60.0, legend_height = 48.0;
constexpr double picture_width = 1000.0;

// Metres in the plane of the needle to pixels of one window of the picture.
struct Window {
  Point2 corner{};                                             // px, top left
  double width = 0.0, height = 0.0;                            // px
  Point2 low{}, high{};                                        // m, what it shows
  double scale() const { return width / (high[0] - low[0]); }  // px/m
  Point2 at(const Point2& p) const {
    return {corner[0] + (p[0] - low[0]) * scale(), corner[1] + (high[1] - p[1]) * scale()};
  }
};

Window window(Point2 corner, double width, Point2 low, Point2 high) {
  return {corner, width, width * (high[1] - low[1]) / (high[0] - low[0]), low, high};
}

CutPolygon in_window(const Window& w, CutPolygon polygon) {
  for (int i = 0; i < polygon.corners; ++i) {
    Point2& p = polygon.corner[static_cast<std::size_t>(i)];
    p = w.at(p);
  }
  return polygon;
}

bool visible(const Window& w, const CutPolygon& polygon) {
  Point2 low{HUGE_VAL, HUGE_VAL}, high{-HUGE_VAL, -HUGE_VAL};
  for (int i = 0; i < polygon.corners; ++i) {
    const Point2& p = polygon.corner[static_cast<std::size_t>(i)];
    for (std::size_t k = 0; k < 2; ++k) low[k] = std::min(low[k], p[k]), high[k] = std::max(high[k], p[k]);
  }
  return low[0] <= w.high[0] && high[0] >= w.low[0] && low[1] <= w.high[1] && high[1] >= w.low[1];
}

int shade(double value, double most) {
  return most > 0.0 ? std::clamp(static_cast<int>(shades * value / most), 0, shades - 1) : 0;
}

void draw_tissue(Svg& svg, const Window& w, const Snapshot& shot, double most) {
  std::array<std::vector<CutPolygon>, shades> by_shade;
  for (std::size_t i = 0; i < shot.section.polygons.size(); ++i) {
    if (!visible(w, shot.section.polygons[i])) continue;
    by_shade[static_cast<std::size_t>(shade(shot.displacement[i], most))].push_back(
        in_window(w, shot.section.polygons[i]));
  }
  for (std::size_t s = 0; s < by_shade.size(); ++s)
    svg.polygons(by_shade[s], joined({"tissue v", std::to_string(s)}));
}

void draw_outline(Svg& svg, const Window& w, const Snapshot& shot) {
  std::vector<std::array<Point2, 2>> pieces;
  for (const auto& piece : shot.section.outline) pieces.push_back({w.at(piece[0]), w.at(piece[1])});
  svg.pieces(pieces, "outline");
}

// To true thickness, with a light halo that sets it off from the tissue.
void draw_needle(Svg& svg, const Window& w, const Snapshot& shot) {
  std::vector<Point2> px;
  for (const Point2& p : shot.needle) px.push_back(w.at(p));
  const double width = 2.0 * shot.needle_radius * w.scale();
  const std::vector<Point2> fewer = simplified(px, 0.1);
  svg.wide_path(fewer, width + 3.0, "halo");
  svg.wide_path(fewer, width, "needle");
}

void draw_arrow(Svg& svg, Point2 point, double length) {
  constexpr double half_head = 5.0, head = 9.0, half_shaft = 1.4;
  const double x = point[0], y = point[1], shoulder = y - std::min(head, 0.7 * length);
  const std::vector<Point2> outline{{x, y},
                                    {x + half_head, shoulder},
                                    {x + half_shaft, shoulder},
                                    {x + half_shaft, y - length},
                                    {x - half_shaft, y - length},
                                    {x - half_shaft, shoulder},
                                    {x - half_head, shoulder}};
  svg.path(outline, true, "force");
}

void draw_scale_bar(Svg& svg, const Window& w, double metres) {
  const double length = metres * w.scale();
  const Point2 from{w.corner[0] + 8.0, w.corner[1] + w.height - 8.0};
  svg.line(from, {from[0] + length, from[1]}, "outline");
  svg.line({from[0], from[1] - 3.0}, {from[0], from[1] + 3.0}, "outline");
  svg.line({from[0] + length, from[1] - 3.0}, {from[0] + length, from[1] + 3.0}, "outline");
  svg.text({from[0] + length / 2.0, from[1] - 6.0}, Anchor::middle, "small",
           joined({short_number(metres / mm, 3), " mm"}));
}

void draw_legend(Svg& svg, Point2 at, double most) {
  constexpr double width = 220.0, height = 11.0;
  svg.text({at[0], at[1] + 10.0}, Anchor::start, "small soft", "displacement of the tissue, mm");
  const double left = at[0] + 186.0;
  for (int s = 0; s < shades; ++s)
    svg.rect({left + width * s / shades, at[1]}, width / shades, height,
             joined({"tissue v", std::to_string(s)}));
  svg.rect({left, at[1]}, width, height, "axis");
  for (int k = 0; k <= 3; ++k)
    svg.text({left + width * k / 3.0, at[1] + height + 14.0}, Anchor::middle, "small soft",
             short_number(most * k / 3.0 / mm, 2));
}

struct Extent {
  double half_width = 0.0, low = 0.0, high = 0.0;  // m
};

Extent extent_of(const std::vector<Snapshot>& shots) {
  Extent e{30.0 * mm, 0.0, 0.0};
  const auto include = [&](const Point2& p) {
    e.half_width = std::max(e.half_width, std::abs(p[0]) + 2.0 * mm);
    e.low = std::min(e.low, p[1]);
    e.high = std::max(e.high, p[1]);
  };
  for (const Snapshot& shot : shots) {
    for (const Point2& p : shot.needle) include(p);
    for (const auto& piece : shot.section.outline) include(piece[0]), include(piece[1]);
  }
  return e;
}

double largest_displacement(const std::vector<Snapshot>& shots) {
  double most = 0.0;
  for (const Snapshot& shot : shots) {
    for (double d : shot.displacement) most = std::max(most, d);
  }
  return most;
}

double largest_force(const std::vector<Snapshot>& shots) {
  double most = 0.0;
  for (const Snapshot& shot : shots) most = std::max(most, std::abs(shot.hand_force));
  return most;
}

void draw_whole(Svg& svg, const Window& w, const Snapshot& shot, double most, double force_scale) {
  svg.begin_clip(w.corner, w.width, w.height);
  draw_tissue(svg, w, shot, most);
  draw_outline(svg, w, shot);
  draw_needle(svg, w, shot);
  if (!shot.needle.empty()) {
    const Point2 hub = w.at(shot.needle.front());
    svg.rect({hub[0] - 5.0, hub[1] - 9.0}, 10.0, 10.0, "hub");
    draw_arrow(svg, {hub[0], hub[1] - 11.0}, std::abs(shot.hand_force) * force_scale);
    svg.text({hub[0] + 10.0, hub[1] - 14.0}, Anchor::start, "force strong small",
             joined({short_number(shot.hand_force, 3), " N"}));
  }
  svg.end_clip();
}

void draw_close(Svg& svg, const Window& w, const Snapshot& shot, double most) {
  svg.begin_clip(w.corner, w.width, w.height);
  draw_tissue(svg, w, shot, most);
  draw_outline(svg, w, shot);
  draw_needle(svg, w, shot);
  svg.end_clip();
  svg.rect(w.corner, w.width, w.height, "axis");
}

}  // namespace

Svg stage_drawing(const std::vector<Snapshot>& shots, const std::string& title,
                  const std::string& description) {
  constexpr double longest_arrow = 34.0;  // px
  const double panel = (picture_width - panel_gap * (static_cast<double>(shots.size()) - 1.0)) /
                       std::max<double>(4.0, static_cast<double>(shots.size()));
  const Extent e = extent_of(shots);
  const double px_per_m = panel / (2.0 * e.half_width);
  const double above = (longest_arrow + 16.0) / px_per_m;  // m, room for hub and arrow
  const Point2 low{-e.half_width, e.low - 2.0 * mm}, high{e.half_width, e.high + above};
  const double whole_height = panel * (high[1] - low[1]) / (high[0] - low[0]);
  const double close_height = panel * (close_above + close_below) / (2.0 * close_half_width);
  Svg svg(picture_width,
          title_height + caption_height + whole_height + panel_gap + close_height + legend_height, title,
          description);
  svg.text({2.0, 18.0}, Anchor::start, "heading", title);
  const double most = largest_displacement(shots),
               force_scale = longest_arrow / std::max(largest_force(shots), 1e-12);
  double x = 0.0;
  char letter = 'a';
  for (const Snapshot& shot : shots) {
    svg.text({x + 2.0, title_height + 14.0}, Anchor::start, "strong",
             joined({"(", std::string(1, letter++), ") ", word(shot.moment)}));
    svg.text({x + 2.0, title_height + 31.0}, Anchor::start, "small soft",
             joined({"hand at ", short_number(shot.hand_travel / mm, 3), " mm, tip at ",
                     short_number(shot.tip_depth / mm, 3), " mm"}));
    svg.text({x + 2.0, title_height + 46.0}, Anchor::start, "small soft",
             joined({"bow ", short_number(shot.deflection / mm, 3), " mm"}));
    const Window whole = window({x, title_height + caption_height}, panel, low, high);
    draw_whole(svg, whole, shot, most, force_scale);
    const Window close =
        window({x + 0.5, title_height + caption_height + whole_height + panel_gap}, panel - 1.0,
               {-close_half_width, -close_below}, {close_half_width, close_above});
    draw_close(svg, close, shot, most);
    if (x == 0.0) draw_scale_bar(svg, whole, 20.0 * mm), draw_scale_bar(svg, close, 5.0 * mm);
    x += panel + panel_gap;
  }
  draw_legend(svg, {2.0, svg.height() - 28.0}, most);
  return svg;
}

Svg mesh_drawing(const Snapshot& rest, int tetrahedra, const std::string& title) {
  const Extent e = extent_of({rest});
  double bottom = 0.0, half = 0.0;
  for (const auto& piece : rest.section.outline)
    bottom = std::min(bottom, piece[0][1]), half = std::max(half, std::abs(piece[0][0]));
  if (half == 0.0) half = e.half_width;
  constexpr double air = 1.0 * mm;
  const Point2 low{-half - air, bottom - air}, high{half + air, 14.0 * mm};
  const Window w = window({0.0, title_height}, 640.0, low, high);
  Svg svg(640.0, title_height + w.height + 6.0, title,
          joined({"Section through the axis of insertion of a mesh of ", std::to_string(tetrahedra),
                  " tetrahedra; the elements grow from the path outwards."}));
  svg.text({2.0, 18.0}, Anchor::start, "heading", title);
  std::vector<CutPolygon> cells;
  for (const CutPolygon& polygon : rest.section.polygons) cells.push_back(in_window(w, polygon));
  svg.polygons(cells, "tissue v1");
  svg.polygons(cells, "mesh");
  draw_outline(svg, w, rest);
  svg.begin_clip(w.corner, w.width, w.height);
  draw_needle(svg, w, rest);
  svg.end_clip();
  draw_scale_bar(svg, w, 10.0 * mm);
  return svg;
}

}  // namespace acus::study
