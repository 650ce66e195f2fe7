#include "acus/needle/elastica.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "acus/needle/buckling.h"
#include "acus/needle/elastica_law.h"
#include "shooting.h"

namespace {

using namespace acus::needle;
using std::numbers::pi;
constexpr double degree = pi / 180.0;

class EachSupport : public testing::TestWithParam<Support> {};
INSTANTIATE_TEST_SUITE_P(Elastica, EachSupport, testing::ValuesIn(all_supports));

// Table of two independent solutions by shooting.
TEST(Elastica, matches_the_published_table_of_loads_bows_and_slopes) {
  struct Row {
    double d, pp_load, pp_bow, cp_load, cp_bow, cp_slope, cp_lateral;
  };
  for (const Row& row : {Row{0.001, 1.0005, 0.0201, 1.0004, 0.0197, 4.5, 0.014},
                         Row{0.010, 1.0050, 0.0635, 1.0038, 0.0620, 14.3, 0.045},
                         Row{0.050, 1.0257, 0.1401, 1.0189, 0.1366, 32.3, 0.104},
                         Row{0.100, 1.0530, 0.1949, 1.0380, 0.1895, 46.3, 0.153},
                         Row{0.200, 1.1127, 0.2663, 1.0758, 0.2569, 67.2, 0.238},
                         Row{0.300, 1.1807, 0.3143, 1.1103, 0.2997, 84.9, 0.326}}) {
    const Elastica pp = elastica(Support::pinned_pinned, row.d);
    EXPECT_NEAR(pp.load_ratio, row.pp_load, 1e-4) << row.d;
    EXPECT_NEAR(pp.bow_ratio, row.pp_bow, 1e-4) << row.d;
    const Elastica cp = elastica(Support::clamped_pinned, row.d);
    EXPECT_NEAR(cp.load_ratio, row.cp_load, 1e-4) << row.d;
    EXPECT_NEAR(cp.bow_ratio, row.cp_bow, 1e-4) << row.d;
    EXPECT_NEAR(cp.tip_slope / degree, row.cp_slope, 0.1) << row.d;
    EXPECT_NEAR(cp.lateral_ratio, row.cp_lateral, 1e-3) << row.d;
  }
}

TEST_P(EachSupport, matches_shooting_at_random_shortenings) {
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> any(shooting::Column::first_shortening,
                                             max_shortening_ratio(GetParam()));
  std::vector<double> shortenings(8);
  for (double& d : shortenings) d = any(random);
  std::sort(shortenings.begin(), shortenings.end());
  shooting::Column column(GetParam());
  const double euler = critical_load(1.0, 1.0, GetParam());
  for (double d : shortenings) {
    const shooting::Buckled shot = column.at(d);
    const Elastica e = elastica(GetParam(), d);
    EXPECT_NEAR(e.load_ratio, shot.load / euler, 1e-8) << d;
    EXPECT_NEAR(e.bow_ratio, shot.bow, 1e-6) << d;  // the shot samples the bow at its steps
    EXPECT_NEAR(e.tip_slope, shot.tip_slope, 1e-8) << d;
    EXPECT_NEAR(e.lateral_ratio, shot.lateral / shot.load, 1e-8) << d;
    EXPECT_NEAR(e.energy_ratio, shot.energy / euler, 1e-8) << d;
  }
}

TEST_P(EachSupport, starts_straight_at_the_critical_load) {
  const Elastica straight = elastica(GetParam(), 0.0);
  EXPECT_NEAR(straight.load_ratio, 1.0, 1e-14);
  EXPECT_EQ(straight.bow_ratio, 0.0);
  EXPECT_EQ(straight.tip_slope, 0.0);
  const Elastica slight = elastica(GetParam(), 1e-5);
  EXPECT_NEAR(1e-5 / (slight.bow_ratio * slight.bow_ratio), small_bow_factor(GetParam()), 1e-4);
}

TEST_P(EachSupport, slightest_shortening_gives_the_slightest_bow) {
  for (double d : {1e-300, 1e-17, 1e-15, 1e-12}) {
    const Elastica e = elastica(GetParam(), d);
    EXPECT_NEAR(e.load_ratio, 1.0, 1e-11) << d;
    EXPECT_NEAR(e.bow_ratio, std::sqrt(d / small_bow_factor(GetParam())), 1e-7) << d;
  }
}

TEST_P(EachSupport, load_is_the_derivative_of_the_bending_energy) {
  constexpr double h = 1e-5;
  for (double d = 0.02; d < 0.69; d += 0.03) {
    const double rise = elastica(GetParam(), d + h).energy_ratio - elastica(GetParam(), d - h).energy_ratio;
    EXPECT_NEAR(rise / (2.0 * h), elastica(GetParam(), d).load_ratio, 2e-8) << d;
  }
}

TEST(Elastica, clamped_pinned_load_has_its_maximum_of_1_14_at_46_percent) {
  double largest = 0.0;
  double where = 0.0;
  for (double d = 0.3; d < 0.6; d += 0.001) {
    const double load = elastica(Support::clamped_pinned, d).load_ratio;
    if (load > largest) where = d;
    largest = std::max(largest, load);
  }
  EXPECT_NEAR(largest, 1.14, 2e-3);
  EXPECT_NEAR(where, 0.46, 1e-2);  // a flat maximum
  EXPECT_LT(elastica(Support::clamped_pinned, 0.7).load_ratio, 0.85);
}

TEST_P(EachSupport, drawn_curve_has_the_length_ends_and_bow_of_the_column) {
  for (double d : {0.0, 1e-6, 0.03, 0.2, 0.5, 0.7}) {
    const Elastica e = elastica(GetParam(), d);
    constexpr int pieces = 4000;
    double length = 0.0;
    double bow = 0.0;
    ElasticaPoint last = elastica_point(e, 0.0);
    EXPECT_NEAR(last.axial, 0.0, 1e-14);
    EXPECT_NEAR(last.lateral, 0.0, 1e-14);
    for (int i = 1; i <= pieces; ++i) {
      const ElasticaPoint p = elastica_point(e, static_cast<double>(i) / pieces);
      const double chord = std::hypot(p.axial - last.axial, p.lateral - last.lateral);
      EXPECT_NEAR(chord, 1.0 / pieces, 1e-9);  // even along the arc
      length += chord;
      bow = std::max(bow, p.lateral);
      last = p;
    }
    EXPECT_NEAR(length, 1.0, 1e-6) << d;
    EXPECT_NEAR(bow, e.bow_ratio, 1e-6) << d;
    EXPECT_NEAR(last.axial, 1.0 - d, 1e-12) << d;
    EXPECT_NEAR(last.lateral, GetParam() == Support::clamped_free ? e.bow_ratio : 0.0, 1e-12) << d;
  }
}

TEST_P(EachSupport, series_of_the_law_reproduce_the_exact_curves) {
  const ElasticaLaw law = build_elastica_law(GetParam());
  for (int i = 1; i <= 97; ++i) {
    const double d = law.max_shortening_ratio * i / 97.0;
    const Elastica e = elastica(GetParam(), d);
    EXPECT_NEAR(load_ratio(law, d).value, e.load_ratio, 1e-11) << d;
    EXPECT_NEAR(energy_ratio(law, d), e.energy_ratio, 1e-11) << d;
    EXPECT_NEAR(bow_ratio(law, std::sqrt(d)), e.bow_ratio, 1e-11) << d;
  }
}

TEST_P(EachSupport, integrals_of_the_law_have_the_load_as_slope_also_beyond_its_range) {
  const ElasticaLaw law = build_elastica_law(GetParam());
  constexpr double h = 1e-5;
  EXPECT_NEAR(energy_ratio(law, 0.0), 0.0, 1e-15);
  EXPECT_EQ(root_integral(law, 0.0), 0.0);
  for (double y = 0.05; y < 1.3; y += 0.0501) {
    const double d = y * y;
    const auto [p, slope] = load_ratio(law, d);
    EXPECT_NEAR((energy_ratio(law, d + h) - energy_ratio(law, d - h)) / (2.0 * h), p, 1e-8) << y;
    EXPECT_NEAR((root_integral(law, y + h) - root_integral(law, y - h)) / (2.0 * h), p, 1e-8) << y;
    EXPECT_NEAR((load_ratio(law, d + h).value - load_ratio(law, d - h).value) / (2.0 * h), slope, 1e-7) << y;
  }
}

}  // namespace
