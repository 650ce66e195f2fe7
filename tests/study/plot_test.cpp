#include "acus/study/plot.h"

#include <gtest/gtest.h>

#include <cmath>
#include <pugixml.hpp>
#include <sstream>

namespace acus::study {
namespace {

Plot awkward_plot() {
  Plot plot;
  plot.title = "Force & travel <of> a \"needle\"";
  plot.description = "r < 0.3 mm";
  plot.x_label = "travel, mm";
  plot.y_label = "force, N";
  Curve curve{"200 mm & more", 0, {}};
  for (int i = 0; i <= 100; ++i) curve.points.push_back({0.5 * i, std::sin(0.1 * i)});
  plot.curves = {curve};
  plot.marks = {{{10.0, 0.5}, MarkShape::diamond, 0, "puncture at <1 N>"}};
  plot.levels = {{0.9, 1, "level \x01 one"}};
  plot.key = {{MarkShape::diamond, "puncture"}};
  return plot;
}

TEST(Plot, a_plot_is_well_formed_whatever_its_words) {
  const std::string document = drawn(awkward_plot()).document();
  pugi::xml_document xml;
  const auto parsed = xml.load_string(document.c_str());
  ASSERT_TRUE(parsed) << parsed.description();
  EXPECT_NE(std::string(xml.child("svg").attribute("aria-label").value()).find("r < 0.3 mm"),
            std::string::npos);
}

TEST(Plot, a_plot_refers_to_nothing_outside_itself) {
  std::string document = drawn(awkward_plot()).document();
  const std::string name = "http://www.w3.org/2000/svg";
  document.erase(document.find(name), name.size());
  for (const char* word : {"http", "url(", "@import", "href", "<script"})
    EXPECT_EQ(document.find(word), std::string::npos) << word;
}

std::vector<Point2> path_points(const pugi::xml_node& path) {
  std::istringstream numbers(std::string(path.attribute("d").value()).substr(1));
  std::vector<Point2> points;
  for (double x = 0.0, y = 0.0; numbers >> x >> y;) points.push_back({x, y});
  return points;
}

TEST(Plot, a_curve_lies_where_the_ticks_say) {
  Plot plot;
  plot.x_label = "travel";
  plot.y_label = "force";
  plot.curves = {{"", 0, {{0.0, 0.0}, {10.0, 40.0}}}};
  plot.x_limits = Point2{0.0, 10.0};
  plot.y_limits = Point2{0.0, 40.0};
  pugi::xml_document xml;
  ASSERT_TRUE(xml.load_string(drawn(plot).document().c_str()));
  const auto curve = xml.select_node("//path[contains(@class,'curve')]").node();
  const std::vector<Point2> points = path_points(curve);
  ASSERT_EQ(points.size(), 2u);
  // The labels "10" on the x axis and "40" on the y axis stand at the end of the curve.
  const auto ten = xml.select_node("//text[@text-anchor='middle' and text()='10']").node(),
             forty = xml.select_node("//text[@text-anchor='end' and text()='40']").node();
  ASSERT_TRUE(ten);
  ASSERT_TRUE(forty);
  EXPECT_NEAR(ten.attribute("x").as_double(), points[1][0], 0.01);
  EXPECT_NEAR(forty.attribute("y").as_double(), points[1][1], 4.01);  // text hangs 4 px below its line
}

TEST(Plot, side_labels_never_cover_each_other) {
  Plot plot = awkward_plot();
  plot.levels.clear();
  for (int i = 0; i < 7; ++i)
    plot.levels.push_back({0.30 + 0.01 * i, i, std::string("level").append(1, static_cast<char>('0' + i))});
  pugi::xml_document xml;
  ASSERT_TRUE(xml.load_string(drawn(plot).document().c_str()));
  std::vector<double> ys;
  for (const auto& label : xml.select_nodes("//text[starts-with(text(),'level')]"))
    ys.push_back(label.node().attribute("y").as_double());
  ASSERT_EQ(ys.size(), 7u);
  std::sort(ys.begin(), ys.end());
  for (std::size_t i = 1; i < ys.size(); ++i) EXPECT_GE(ys[i] - ys[i - 1], 12.0);
}

TEST(Plot, stacked_bands_add_up_to_their_sum) {
  StackPlot plot;
  plot.x = {0.0, 1.0, 2.0};
  plot.bands = {{"one", 0, {0.0, 1.0, 2.0}}, {"two", 1, {0.0, 2.0, 4.0}}};
  plot.total = {"sum", 6, {{0.0, 0.0}, {2.0, 6.0}}};
  pugi::xml_document xml;
  ASSERT_TRUE(xml.load_string(drawn(plot).document().c_str()));
  const auto bands = xml.select_nodes("//path[contains(@class,'band')]");
  ASSERT_EQ(bands.size(), 2u);
  const auto total = path_points(xml.select_node("//path[contains(@class,'outline')]").node());
  double highest = 1e9;
  for (const Point2& p : path_points(bands[1].node())) highest = std::min(highest, p[1]);
  EXPECT_NEAR(highest, total.back()[1], 0.01);
}

}  // namespace
}  // namespace acus::study
