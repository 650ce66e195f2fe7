// Two threads and a mailbox: nothing torn, nothing that goes back in time, and the last word arrives.
#include "acus/haptics/newest_value.h"

#include <gtest/gtest.h>

#include <thread>

namespace acus::haptics {
namespace {

TEST(NewestValue, is_the_first_one_until_something_is_written) {
  NewestValue<double> mailbox(3.5);
  EXPECT_EQ(mailbox.read(), 3.5);
  EXPECT_EQ(mailbox.read(), 3.5);
}

TEST(NewestValue, replaces_what_nobody_read) {
  NewestValue<int> mailbox;
  for (int i = 1; i <= 5; ++i) mailbox.write(i);
  EXPECT_EQ(mailbox.read(), 5);
  EXPECT_EQ(mailbox.read(), 5);
  mailbox.write(6);
  EXPECT_EQ(mailbox.read(), 6);
}

TEST(NewestValue, crosses_threads_whole_and_in_order) {
  struct Wide {
    std::array<long, 16> same{};
  };
  constexpr long last = 200'000;
  NewestValue<Wide> mailbox;
  std::thread writer([&] {
    Wide value;
    for (long i = 1; i <= last; ++i) {
      value.same.fill(i);
      mailbox.write(value);
    }
  });
  long before = 0, torn = 0, backwards = 0;
  while (before < last) {
    const Wide& now = mailbox.read();
    for (long part : now.same) torn += part != now.same[0];
    backwards += now.same[0] < before;
    before = now.same[0];
  }
  writer.join();
  EXPECT_EQ(torn, 0);
  EXPECT_EQ(backwards, 0);
}

}  // namespace
}  // namespace acus::haptics
