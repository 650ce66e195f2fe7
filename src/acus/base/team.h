// Team: threads that share the pieces of a task among them.
//
// Who does a piece and when is left to chance. So what a piece writes may depend on nothing that another one
// of the same task does, and into how many pieces a task is cut must not depend on the number of threads:
// then the results have the same bits for any number.
#pragma once

#include <cassert>
#include <memory>

namespace acus {

inline constexpr int most_threads = 64;

class Team {
 public:
  // The caller is one of the threads; the others start here and end with the team. Where the system gives
  // fewer, fewer do the work.
  explicit Team(int threads = 1);
  Team(Team&&) noexcept;
  Team& operator=(Team&&) noexcept;
  ~Team();

  // f(0) .. f(pieces - 1), in any order and side by side; returns when all are done. Neither allocates nor
  // locks. f must not throw, nor give work to the same team; nor may two callers at once. At most
  // `most_pieces_of_a_task`.
  template <class F>
  void run(int pieces, const F& f) const {
    assert(pieces <= most_pieces_of_a_task);
    if (!shared_ || pieces == 1) {
      for (int piece = 0; piece < pieces; ++piece) f(piece);
    } else {
      share(
          pieces, [](const void* task, int piece) { (*static_cast<const F*>(task))(piece); }, &f);
    }
  }
  static constexpr int most_pieces_of_a_task = 0xffff;

 private:
  using Call = void (*)(const void* task, int piece);
  void share(int pieces, Call call, const void* task) const;

  struct Shared;
  std::unique_ptr<Shared> shared_;  // none for one thread
};

inline const Team one_thread;

}  // namespace acus
