#include "studio/lease.h"

#include <gtest/gtest.h>

namespace acus::app {
namespace {

TEST(Lease, is_of_one_client_for_a_second_after_its_last_word) {
  Lease lease;
  EXPECT_FALSE(lease.lapsed(0.0));
  EXPECT_TRUE(lease.is_open_to(1, 0.0));
  EXPECT_TRUE(lease.take(1, 0.0));
  EXPECT_FALSE(lease.take(2, 0.9));
  EXPECT_TRUE(lease.take(1, 0.9));
  EXPECT_FALSE(lease.take(2, 1.8));
  EXPECT_TRUE(lease.is_open_to(1, 1.9));
  EXPECT_FALSE(lease.is_open_to(2, 1.9));
  EXPECT_TRUE(lease.is_open_to(2, 1.91));
  EXPECT_TRUE(lease.take(2, 1.91));
  EXPECT_FALSE(lease.take(1, 1.91));
}

TEST(Lease, lapses_once) {
  Lease lease;
  lease.take(1, 0.0);
  EXPECT_FALSE(lease.lapsed(1.0));
  EXPECT_TRUE(lease.lapsed(1.1));
  EXPECT_FALSE(lease.lapsed(2.0));
  lease.take(1, 2.0);
  lease.give_back(2);
  EXPECT_FALSE(lease.lapsed(2.0));
  lease.give_back(1);
  EXPECT_TRUE(lease.lapsed(2.0));
  EXPECT_TRUE(lease.take(2, 2.0));
}

}  // namespace
}  // namespace acus::app
