#include "acus/base/team.h"

#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <chrono>
#include <ctime>
#include <memory>
#include <thread>
#include <utility>
#include <vector>

namespace acus {
namespace {

double processor_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

// Plain numbers, so that a sanitizer sees it where two tasks overlap.
TEST(Team, does_every_piece_exactly_once) {
  constexpr int most = 40, rounds = 4000;
  for (int threads : {1, 2, 3, 8, 17}) {  // also more than there are cores
    const Team team(threads);
    std::array<int, most> done{};
    std::array<int, most> expected{};
    for (int round = 0; round < rounds; ++round) {
      const int pieces = round % (most + 1);
      team.run(pieces, [&](int piece) { ++done[piece]; });
      for (int piece = 0; piece < pieces; ++piece) ++expected[piece];
    }
    EXPECT_EQ(done, expected) << threads << " threads";
  }
}

TEST(Team, shows_a_task_what_the_one_before_has_written) {
  constexpr int pieces = 8, rounds = 4000;
  for (int threads : {2, 4}) {
    const Team team(threads);
    std::array<int, pieces> before{}, after{};
    for (int round = 0; round < rounds; ++round) {
      team.run(pieces, [&](int piece) { after[piece] = before[(piece + 3) % pieces] + 1; });
      std::swap(before, after);
    }
    for (int value : before) EXPECT_EQ(value, rounds) << threads << " threads";
  }
}

// Neither piece ends before both have begun.
TEST(Team, does_pieces_side_by_side) {
  const Team team(2);
  std::atomic<int> begun{0};
  team.run(2, [&](int) {
    ++begun;
    while (begun < 2) std::this_thread::yield();
  });
  EXPECT_EQ(begun, 2);
}

TEST(Team, of_one_works_in_order_on_the_thread_of_its_caller) {
  std::vector<int> order;
  one_thread.run(4, [&, caller = std::this_thread::get_id()](int piece) {
    EXPECT_EQ(std::this_thread::get_id(), caller);
    order.push_back(piece);
  });
  EXPECT_EQ(order, (std::vector<int>{0, 1, 2, 3}));
}

TEST(Team, sleeps_while_there_is_nothing_to_do_and_wakes_again) {
  const Team team(4);
  const double before = processor_seconds();
  constexpr int naps = 5;
  std::atomic<int> done{0};
  for (int nap = 0; nap < naps; ++nap) {
    team.run(8, [&](int) { ++done; });
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  }
  EXPECT_EQ(done, 8 * naps);
  EXPECT_LT(processor_seconds() - before, 0.25);  // s; three that never sleep would take up to 1.5
  // The last of them may be asleep, or on its way there.
  team.run(2, [&, begun = std::make_shared<std::atomic<int>>(0)](int) {
    ++*begun;
    while (*begun < 2) std::this_thread::yield();
  });
}

TEST(Team, can_be_moved_and_replaced) {
  Team team(2);
  Team other = std::move(team);
  team = Team(3);
  std::atomic<int> done{0};
  for (const Team* t : {&team, &other}) t->run(100, [&](int) { ++done; });
  other = Team();
  other.run(100, [&](int) { ++done; });
  EXPECT_EQ(done, 300);
}

}  // namespace
}  // namespace acus
