#include "acus/needle/column.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "acus/needle/buckling.h"

namespace {

using namespace acus::needle;
using std::numbers::pi;

NeedleSpec needle(Support support, double imperfection) {
  NeedleSpec spec;
  spec.support = support;
  spec.imperfection = imperfection;
  return spec;
}

double euler_load(const NeedleSpec& spec, double free_length) {
  return critical_load(bending_rigidity(spec), free_length, spec.support);
}

class ColumnOfEachSupport : public testing::TestWithParam<Support> {};
INSTANTIATE_TEST_SUITE_P(Column, ColumnOfEachSupport, testing::ValuesIn(all_supports));

// Southwell (1932): below the critical load, growth of the bow over load is linear in the growth; the slope
// is 1 / Pcr.
TEST_P(ColumnOfEachSupport, southwell_plot_gives_the_euler_load) {
  const NeedleSpec spec = needle(GetParam(), 0.05e-3);
  const Column column = build_column(spec);
  const double initial = column_response(column, spec.length, 0.0).bow;
  double n = 0, sx = 0, sy = 0, sxx = 0, sxy = 0;
  for (double shortening = 0.0; shortening < 1e-3; shortening += 2e-8) {
    const ColumnResponse r = column_response(column, spec.length, shortening);
    if (r.load < 0.3 * euler_load(spec, spec.length) || r.load > 0.95 * euler_load(spec, spec.length))
      continue;
    const double x = r.bow - initial;
    const double y = x / r.load;
    n += 1, sx += x, sy += y, sxx += x * x, sxy += x * y;
  }
  ASSERT_GT(n, 10);
  const double slope = (n * sxy - sx * sy) / (n * sxx - sx * sx);
  EXPECT_NEAR(1.0 / slope / euler_load(spec, spec.length), 1.0, 5e-3);
}

// Perry's column: P = Pcr (1 - A0 / A) while the bow is small.
TEST_P(ColumnOfEachSupport, small_bows_grow_as_perry_says) {
  const NeedleSpec spec = needle(GetParam(), 0.05e-3);
  const Column column = build_column(spec);
  EXPECT_NEAR(column_response(column, spec.length, 0.0).bow / spec.imperfection, 1.0, 1e-6);
  for (double shortening : {-5e-6, -1e-6, 5e-7, 1e-6, 2e-6, 4e-6}) {
    const ColumnResponse r = column_response(column, spec.length, shortening);
    EXPECT_NEAR(r.load / euler_load(spec, spec.length), 1.0 - spec.imperfection / r.bow, 1e-4) << shortening;
  }
}

TEST_P(ColumnOfEachSupport, perfect_column_is_a_bar_up_to_the_euler_load_and_an_elastica_above) {
  const NeedleSpec spec = needle(GetParam(), 0.0);
  const Column column = build_column(spec);
  const double euler = euler_load(spec, spec.length);
  const double at_buckling = euler * spec.length / axial_rigidity(spec);
  for (double part : {-3.0, -0.5, 0.0, 0.5, 0.999999}) {
    const ColumnResponse r = column_response(column, spec.length, part * at_buckling);
    EXPECT_NEAR(r.load, part * euler, 1e-12 * euler) << part;
    EXPECT_EQ(r.bow, 0.0);
    EXPECT_NEAR(r.energy, 0.5 * r.load * r.load * spec.length / axial_rigidity(spec), 1e-16);
  }
  for (double part : {1.0 - 1e-9, 1.0, 1.0 + 1e-9, 1.0 + 1e-6})
    EXPECT_NEAR(column_response(column, spec.length, part * at_buckling).load / euler, 1.0, 2e-9) << part;
  for (double d : {0.01, 0.1, 0.3, 0.6}) {
    const Elastica e = elastica(GetParam(), d);
    const double shortening = d * spec.length + e.load_ratio * at_buckling;
    const ColumnResponse r = column_response(column, spec.length, shortening);
    EXPECT_NEAR(r.shortening_ratio, d, 1e-10);
    EXPECT_NEAR(r.load / euler, e.load_ratio, 1e-9);
    EXPECT_NEAR(r.bow / spec.length, e.bow_ratio, 1e-9);
  }
}

// The elastica's published table, for the default needle with its small initial bow.
TEST(Column, buckled_needle_follows_the_published_table) {
  struct Row {
    double d, pp_load, pp_bow, cp_load, cp_bow;
  };
  const Column pp = build_column(needle(Support::pinned_pinned, 0.05e-3));
  const Column cp = build_column(needle(Support::clamped_pinned, 0.05e-3));
  const double euler = euler_load(needle(Support::pinned_pinned, 0.0), 0.2);
  for (const Row& row :
       {Row{0.010, 1.0050, 0.0635, 1.0038, 0.0620}, Row{0.050, 1.0257, 0.1401, 1.0189, 0.1366},
        Row{0.100, 1.0530, 0.1949, 1.0380, 0.1895}, Row{0.200, 1.1127, 0.2663, 1.0758, 0.2569},
        Row{0.300, 1.1807, 0.3143, 1.1103, 0.2997}}) {
    const ColumnResponse a = column_response(pp, 0.2, 0.2 * row.d);
    EXPECT_NEAR(a.load / euler, row.pp_load, 0.01 * row.pp_load);
    EXPECT_NEAR(a.bow / 0.2, row.pp_bow, 0.01 * row.pp_bow);
    const ColumnResponse b = column_response(cp, 0.2, 0.2 * row.d);
    EXPECT_NEAR(b.load / (2.0457483 * euler), row.cp_load, 0.01 * row.cp_load);
    EXPECT_NEAR(b.bow / 0.2, row.cp_bow, 0.01 * row.cp_bow);
  }
}

// Eshelby's force on the free length: the end force times the cosine of its angle with the needle where the
// moment is zero.
TEST(Column, pinned_entry_gives_back_the_part_of_the_load_along_the_needle) {
  const Column column = build_column(needle(Support::pinned_pinned, 0.0));
  const double euler = euler_load(needle(Support::pinned_pinned, 0.0), 0.2);
  for (double alpha_deg : {5.0, 20.0, 60.0, 90.0, 120.0}) {
    const double k = std::sin(alpha_deg * pi / 360.0);
    const double first = std::comp_ellint_1(k);
    const double load = euler * std::pow(2.0 * first / pi, 2);
    const double shortening =
        0.2 * 2.0 * (1.0 - std::comp_ellint_2(k) / first) + 0.2 * load / column.axial_rigidity;
    const ColumnResponse r = column_response(column, 0.2, shortening);
    EXPECT_NEAR((r.load + r.configurational_force) / load, std::cos(alpha_deg * pi / 180.0), 1e-4)
        << alpha_deg;
  }
}

TEST_P(ColumnOfEachSupport, configurational_force_is_the_end_force_along_the_needle_where_no_moment_acts) {
  const NeedleSpec spec = needle(GetParam(), 0.0);
  const Column column = build_column(spec);
  for (double d : {0.01, 0.1, 0.3, 0.6}) {
    const Elastica e = elastica(GetParam(), d);
    const double load = e.load_ratio * euler_load(spec, 0.2);
    const ColumnResponse r = column_response(column, 0.2, 0.2 * (d + load / column.axial_rigidity));
    const double end_force = std::hypot(load, e.lateral_ratio * load);
    EXPECT_NEAR(r.load + r.configurational_force, end_force * (1.0 - 2.0 * e.modulus * e.modulus),
                1e-4 * load)
        << d;
  }
}

TEST_P(ColumnOfEachSupport, folded_column_keeps_a_finite_load_and_says_so) {
  const Column column = build_column(needle(GetParam(), 0.05e-3));
  const double limit = max_shortening_ratio(GetParam());
  const ColumnResponse before = column_response(column, 0.2, 0.2 * (limit - 1e-3));
  const ColumnResponse after = column_response(column, 0.2, 0.2 * (limit + 1e-3));
  const ColumnResponse far = column_response(column, 0.2, 1.0);
  EXPECT_FALSE(before.folded);
  EXPECT_TRUE(after.folded);
  EXPECT_TRUE(far.folded);
  EXPECT_NEAR(after.load, before.load, 0.01 * before.load);
  EXPECT_NEAR(far.load, after.load, 1e-3 * after.load);
}

TEST_P(ColumnOfEachSupport, drawn_line_runs_from_hub_to_entry_with_the_length_and_bow_of_the_needle) {
  const NeedleSpec spec = needle(GetParam(), 0.05e-3);
  const Column column = build_column(spec);
  for (double shortening : {-1e-5, 0.0, 2e-6, 1e-3, 0.02, 0.1}) {
    const ColumnResponse r = column_response(column, 0.15, shortening);
    const std::vector<ElasticaPoint> line = column_line(column, 0.15, shortening, 2001);
    ASSERT_EQ(line.size(), 2001u);
    double length = 0.0;
    double bow = 0.0;
    for (std::size_t i = 1; i < line.size(); ++i) {
      length += std::hypot(line[i].axial - line[i - 1].axial, line[i].lateral - line[i - 1].lateral);
      bow = std::max(bow, line[i].lateral);
    }
    EXPECT_NEAR(line.front().axial, 0.0, 1e-15);
    EXPECT_NEAR(line.back().axial, 0.15 - shortening, 1e-13);
    // Compression shortens the needle a little; the drawing takes it from the span.
    const double compression = std::abs(r.load) / column.axial_rigidity * 0.15 / (0.15 - shortening);
    EXPECT_NEAR(length / 0.15, 1.0, 1e-6 + compression) << shortening;
    EXPECT_NEAR(bow, r.bow, 1e-6 * r.bow) << shortening;
  }
}

}  // namespace
