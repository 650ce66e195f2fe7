#include "acus/base/team.h"

#ifdef __EMSCRIPTEN__  // no threads there

namespace acus {

struct Team::Shared {};
Team::Team(int /*threads*/) {}
void Team::share(int, Call, const void*) const {}

#else

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

namespace acus {
namespace {

constexpr std::size_t cache_line = 64;

// A pause is some 20 to 50 ns. Between two parts of a step there is often little to wait for, and to be woken
// takes longer than that; for the last pieces of a task there should be less, unless who has them is
// interrupted.
constexpr int spins_before_sleep = 8000, spins_for_the_last = 1500;

void pause() {
#if defined(__x86_64__) || defined(__i386__)
  __builtin_ia32_pause();
#elif defined(__aarch64__)
  asm volatile("yield");
#endif
}

// A task and which of its pieces nobody has taken yet, `front` to `back`, in one number, so that a piece is
// taken by one exchange; a thread that comes late finds another task's number and takes nothing of the old.
using Ticket = std::uint64_t;
constexpr int front_bits = 16, task_bits = 32;
int front(Ticket t) { return static_cast<int>(t >> front_bits & 0xffff); }
int back(Ticket t) { return static_cast<int>(t & 0xffff); }
bool any_left(Ticket t) { return front(t) < back(t); }
Ticket next_task(Ticket t, int pieces) {
  return ((t >> task_bits) + 1) << task_bits | static_cast<Ticket>(pieces);
}

}  // namespace

struct Team::Shared {
  // Written by the caller while nobody works.
  Call call = nullptr;
  const void* task = nullptr;
  std::atomic<int> at_once{1};  // pieces. Who reads that of another task does not get his ticket

  alignas(cache_line) std::atomic<Ticket> ticket{0};
  alignas(cache_line) std::atomic<int> done{0};  // pieces of the task
  std::atomic<bool> caller_asleep{false};
  alignas(cache_line) std::atomic<int> asleep{0};
  std::atomic<int> calls{0};  // what sleepers wait on
  std::atomic<bool> over{false};
  std::vector<std::thread> workers;

  // Each takes its share at once, which costs two exchanges between cores and not two a piece; what others
  // are late for, whoever is done takes too. The caller takes from the front and the others from the back, so
  // that of two each finds in its cache what it had there before.
  enum class End { front, back };
  bool do_some(End end) {
    Ticket t = ticket.load(std::memory_order_acquire);
    while (any_left(t)) {
      const int some = std::min(at_once.load(std::memory_order_relaxed), back(t) - front(t));
      const Ticket rest = end == End::front ? t + (static_cast<Ticket>(some) << front_bits) : t - some;
      if (!ticket.compare_exchange_weak(t, rest, std::memory_order_acq_rel, std::memory_order_acquire))
        continue;
      const int first = end == End::front ? front(t) : back(t) - some;
      for (int piece = first; piece < first + some; ++piece) call(task, piece);
      done.fetch_add(some);
      if (caller_asleep.load()) done.notify_one();
      return true;
    }
    return false;
  }

  // All in one order: either the sleeper still sees what has come, or the caller that he sleeps.
  void sleep() {
    asleep.fetch_add(1);
    const int before = calls.load();
    if (!any_left(ticket.load()) && !over.load()) calls.wait(before);
    asleep.fetch_sub(1);
  }
  void wake() {
    if (asleep.load() == 0) return;
    calls.fetch_add(1);
    calls.notify_all();
  }

  // Another was interrupted over its pieces: while the caller sleeps the system may go on with him here.
  void wait_for(int pieces) {
    caller_asleep.store(true);
    const int so_far = done.load();
    if (so_far < pieces) done.wait(so_far);
    caller_asleep.store(false);
  }

  void work() {
    int idle = 0;
    while (!over.load(std::memory_order_relaxed)) {
      if (do_some(End::back)) {
        idle = 0;
      } else if (++idle < spins_before_sleep) {
        pause();
      } else {
        sleep();
        idle = 0;
      }
    }
  }
};

Team::Team(int threads) {
  if (threads <= 1) return;
  shared_ = std::make_unique<Shared>();
  shared_->workers.reserve(static_cast<std::size_t>(threads) - 1);
  try {
    for (int i = 1; i < threads; ++i) shared_->workers.emplace_back([s = shared_.get()] { s->work(); });
  } catch (const std::system_error&) {  // no more threads to be had: those that are there do
  }
}

void Team::share(int pieces, Call call, const void* task) const {
  Shared& s = *shared_;
  s.call = call;
  s.task = task;
  s.at_once.store(std::max(1, pieces / static_cast<int>(s.workers.size() + 1)), std::memory_order_relaxed);
  s.done.store(0, std::memory_order_relaxed);
  s.ticket.store(next_task(s.ticket.load(std::memory_order_relaxed), pieces));
  s.wake();
  while (s.do_some(Shared::End::front)) continue;
  for (int idle = 0; s.done.load(std::memory_order_acquire) < pieces; ++idle)
    if (idle < spins_for_the_last)
      pause();
    else
      s.wait_for(pieces);
}

#endif

Team::Team(Team&&) noexcept = default;

Team& Team::operator=(Team&& other) noexcept {
  std::swap(shared_, other.shared_);
  return *this;
}

Team::~Team() {
#ifndef __EMSCRIPTEN__
  if (!shared_) return;
  shared_->over = true;
  shared_->calls.fetch_add(1);
  shared_->calls.notify_all();
  for (std::thread& worker : shared_->workers) worker.join();
#endif
}

}  // namespace acus
