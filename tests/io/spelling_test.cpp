#include "acus/io/spelling.h"

#include <gtest/gtest.h>

namespace acus::io {
namespace {

TEST(Spelling, distances_are_those_of_the_textbook_pairs) {
  EXPECT_EQ(edit_distance("kitten", "sitting"), 3);
  EXPECT_EQ(edit_distance("saturday", "sunday"), 3);
  EXPECT_EQ(edit_distance("", "abc"), 3);
  EXPECT_EQ(edit_distance("same", "same"), 0);
}

TEST(Spelling, finds_the_key_that_was_meant_and_stays_silent_when_none_was) {
  const std::vector<std::string> keys = {"needle.length_mm", "needle.radius_mm", "contact.rupture_force_N"};
  EXPECT_EQ(nearest_word("needle.lenght_mm", keys), "needle.length_mm");
  EXPECT_EQ(nearest_word("needle.length", keys), "needle.length_mm");
  EXPECT_EQ(nearest_word("tissue.rupture_force_N", keys), "contact.rupture_force_N");
  EXPECT_EQ(nearest_word("qqqqqqqqqqqqq", keys), "");
}

}  // namespace
}  // namespace acus::io
