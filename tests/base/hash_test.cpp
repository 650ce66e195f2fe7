#include "acus/base/hash.h"

#include <gtest/gtest.h>

#include <array>
#include <limits>

// FNV-1a of eight zero bytes and of the bytes of int 97, from the published algorithm run by hand in Python.
TEST(Hash, follows_the_published_fnv1a) {
  EXPECT_EQ(acus::hex(acus::hash_of(std::array<int, 1>{97})), "ac804b820e4fe984");
  EXPECT_EQ(acus::hex(acus::hash_of(std::array<double, 1>{0.0})), "a8c7f832281a39c5");
}

// Of "", "a" and "foobar", from the tables of the FNV draft (draft-eastlake-fnv, appendix C).
TEST(Hash, of_bytes_is_the_published_fnv1a) {
  EXPECT_EQ(acus::hex(acus::hash_of_bytes("")), "cbf29ce484222325");
  EXPECT_EQ(acus::hex(acus::hash_of_bytes("a")), "af63dc4c8601ec8c");
  EXPECT_EQ(acus::hex(acus::hash_of_bytes("foobar")), "85944171f73967e8");
}

TEST(Hash, tells_neighbouring_doubles_apart_but_not_the_sign_of_zero) {
  const double next = std::nextafter(1.0, 2.0);
  EXPECT_NE(acus::hash_of(std::array<double, 1>{1.0}), acus::hash_of(std::array<double, 1>{next}));
  EXPECT_EQ(acus::hash_of(std::array<double, 1>{0.0}), acus::hash_of(std::array<double, 1>{-0.0}));
}
