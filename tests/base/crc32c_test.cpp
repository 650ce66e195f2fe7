#include "acus/base/crc32c.h"

#include <gtest/gtest.h>

#include <string>

// The check value of the catalogues, and test vectors of RFC 3720, B.4 (there printed byte by byte, lowest
// first).
TEST(Crc32c, has_the_published_values) {
  EXPECT_EQ(acus::crc32c("123456789"), 0xE3069283U);
  EXPECT_EQ(acus::crc32c(std::string(32, '\0')), 0x8A9136AAU);
  EXPECT_EQ(acus::crc32c(std::string(32, '\xff')), 0x62A8AB43U);
  std::string rising(32, '\0');
  for (std::size_t i = 0; i < rising.size(); ++i) rising[i] = static_cast<char>(i);
  EXPECT_EQ(acus::crc32c(rising), 0x46DD794EU);
}

TEST(Crc32c, goes_on_where_it_was) {
  EXPECT_EQ(acus::crc32c("6789", acus::crc32c("12345")), acus::crc32c("123456789"));
  EXPECT_EQ(acus::crc32c("", 17), 17U);
}
