#include "acus/study/expansion.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

namespace acus::study {
namespace {

TEST(Expansion, a_grid_is_every_combination_with_the_first_axis_slowest) {
  const std::vector<Axis> axes{{"needle.support", {"\"pinned_pinned\"", "\"clamped_pinned\""}},
                               {"needle.length_mm", {"150", "200", "300"}}};
  const std::vector<Case> cases = grid(axes);
  const char* by_hand[] = {"pinned_pinned-length_mm_150",  "pinned_pinned-length_mm_200",
                           "pinned_pinned-length_mm_300",  "clamped_pinned-length_mm_150",
                           "clamped_pinned-length_mm_200", "clamped_pinned-length_mm_300"};
  ASSERT_EQ(cases.size(), std::size(by_hand));
  for (std::size_t i = 0; i < cases.size(); ++i) EXPECT_EQ(cases[i].name, by_hand[i]);
  EXPECT_EQ(cases[4].choices,
            (std::vector<Choice>{{"needle.support", "\"clamped_pinned\""}, {"needle.length_mm", "200"}}));
}

TEST(Expansion, no_axes_are_one_run) { EXPECT_EQ(grid({}).size(), 1u); }

TEST(Expansion, names_fit_a_file_system) {
  EXPECT_EQ(name_part({"tissue.mesh", "\"../organs/liver 2.msh\""}), ".._organs_liver_2.msh");
  EXPECT_EQ(name_part({"tissue.size_mm", "[100.0, 50.0]"}), "size_mm__100.0__50.0_");
  EXPECT_EQ(fitted_name(".._organs", 200), "_._organs");
  EXPECT_EQ(fitted_name("length_mm_150", 200), "length_mm_150");
  std::string name(1000, 'a');
  const std::string one = fitted_name(name, 200);
  name.back() = 'b';
  const std::string two = fitted_name(name, 200);
  EXPECT_EQ(one.size(), 200u);
  EXPECT_NE(one, two);
}

TEST(Expansion, a_random_sample_is_repeatable_and_stays_in_its_ranges) {
  const std::vector<RandomRange> ranges{{"needle.radius_mm", 0.2, 0.4, false},
                                        {"tissue.tetrahedra", 1000, 1003, true}};
  const std::vector<Case> once = random_sample(ranges, 500, 7), again = random_sample(ranges, 500, 7);
  ASSERT_EQ(once.size(), 500u);
  std::set<std::string> counts;
  double mean = 0.0;
  for (std::size_t i = 0; i < once.size(); ++i) {
    EXPECT_EQ(once[i].choices, again[i].choices);
    const double radius = std::stod(once[i].choices[0].value);
    EXPECT_GE(radius, 0.2);
    EXPECT_LE(radius, 0.4);
    mean += radius / 500.0;
    counts.insert(once[i].choices[1].value);
  }
  EXPECT_EQ(counts, (std::set<std::string>{"1000", "1001", "1002", "1003"}));
  // The mean of 500 even draws has a standard deviation of 0.2 / sqrt(12 * 500): five of them.
  EXPECT_NEAR(mean, 0.3, 5.0 * 0.2 / std::sqrt(12.0 * 500.0));
  EXPECT_NE(random_sample(ranges, 5, 8)[0].choices, once[0].choices);
}

// The C++ standard ([rand.predef]) fixes the sequence: its 10000th word is 9981545732273789042 for the
// default seed.
TEST(Expansion, a_random_sample_is_the_same_on_every_machine) {
  const std::vector<RandomRange> range{{"x.y", 0.0, 1.0, false}};
  const std::vector<Case> cases = random_sample(range, 10000, 5489);
  EXPECT_NEAR(std::stod(cases.back().choices[0].value), 9981545732273789042.0 / 18446744073709551616.0, 1e-6);
}

}  // namespace
}  // namespace acus::study
