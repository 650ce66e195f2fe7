// Eq. 11 as printed against the exact elastica of the same span and end slope.
#include <cmath>
#include <numbers>

#include "acus/needle/elastica.h"
#include "acus/needle/paper_deflection.h"
#include "acus/study/exhibits.h"
#include "acus/study/markup.h"

namespace acus::study {
namespace {

constexpr double degree = std::numbers::pi / 180.0;
constexpr int points = 121;
constexpr double drawn_slopes[] = {20.0, 40.0, 60.0, 80.0};  // degrees

// The pinned-pinned elastica whose ends stand at `slope` [rad]: by bisection, for the slope grows with the
// shortening.
needle::Elastica elastica_of_slope(double slope) {
  double low = 0.0, high = 0.9;  // at 0.9 the ends point backwards
  for (int i = 0; i < 60; ++i) {
    const double middle = (low + high) / 2.0;
    (needle::elastica(needle::Support::pinned_pinned, middle).tip_slope < slope ? low : high) = middle;
  }
  return needle::elastica(needle::Support::pinned_pinned, low);
}

struct Shapes {
  std::vector<Point2> exact, printed;  // along and across, over the length
  double exact_bow = 0.0, printed_bow = 0.0, span = 0.0, printed_length = 0.0;
};

Shapes shapes_of(double slope) {
  const needle::Elastica exact = elastica_of_slope(slope);
  Shapes shapes;
  shapes.span = 1.0 - exact.shortening_ratio;
  shapes.exact_bow = exact.bow_ratio;
  shapes.printed_bow = needle::paper_amplitude(shapes.span, slope);
  for (int i = 0; i < points; ++i) {
    const double share = static_cast<double>(i) / (points - 1);
    const needle::ElasticaPoint p = needle::elastica_point(exact, share);
    shapes.exact.push_back({p.axial, p.lateral});
    shapes.printed.push_back(
        {share * shapes.span, needle::paper_shape(share * shapes.span, shapes.span, slope)});
    if (i > 0) {
      const Point2 &a = shapes.printed[static_cast<std::size_t>(i) - 1],
                   &b = shapes.printed[static_cast<std::size_t>(i)];
      shapes.printed_length += std::hypot(b[0] - a[0], b[1] - a[1]);
    }
  }
  return shapes;
}

}  // namespace

void show_shapes(Page& page, const GroupRecords& group) {
  Plot plot;
  plot.title = "Shape of a buckled needle: Eq. 11 and the elastica";
  plot.description =
      "Solid: exact elastica; dashed: Eq. 11 with the same span and end slope, at 20, 40, 60 and 80 degrees.";
  plot.x_label = "along the axis / length";
  plot.y_label = "deflection / length";
  plot.equal_scales = true;
  Table table{"Eq. 11 with the span and end slope of the exact elastica; lengths over the needle's length",
              {"end slope", "span", "bow, elastica", "bow, Eq. 11", "off by", "arc length, Eq. 11"},
              {}};
  for (std::size_t i = 0; i < std::size(drawn_slopes); ++i) {
    const Shapes shapes = shapes_of(drawn_slopes[i] * degree);
    const int style = static_cast<int>(i);
    const std::string name = joined({number(drawn_slopes[i], 2), "\u00b0"});
    plot.curves.push_back({"", style, shapes.exact, Curve::Dash::solid});
    plot.curves.push_back({"", style, shapes.printed, Curve::Dash::dashed});
    plot.marks.push_back(
        {{shapes.span / 2.0, shapes.exact_bow}, MarkShape::circle, style, joined({name, ", elastica"})});
    plot.marks.push_back(
        {{shapes.span / 2.0, shapes.printed_bow}, MarkShape::diamond, style, joined({name, ", Eq. 11"})});
    plot.levels.push_back(
        {shapes.printed_bow, style, joined({name, ": ", percent_off(shapes.printed_bow, shapes.exact_bow)})});
    table.rows.push_back({name, number(shapes.span), number(shapes.exact_bow), number(shapes.printed_bow),
                          percent_off(shapes.printed_bow, shapes.exact_bow), number(shapes.printed_length)});
  }
  plot.key = {{MarkShape::circle, "elastica (solid)"}, {MarkShape::diamond, "Eq. 11 (dashed)"}};
  page.figure(joined({group.group->name, "-shapes"}), drawn(plot),
              "A pinned-pinned needle of one length, buckled until its ends stand at the angle on the right. "
              "Eq. 11 holds for small "
              "angles only; the percentages tell how much too far out it draws the bow.",
              {});
  page.table(table);
}

}  // namespace acus::study
