#include "interruption.h"

#include <atomic>
#include <csignal>

namespace acus::app {
namespace {

// Written by the handler of a signal and read by every thread: only an atomic without a lock may be both.
std::atomic<int> asked_to_stop{0};
static_assert(std::atomic<int>::is_always_lock_free);

void remember(int signal_number) {
  asked_to_stop = 1;
  std::signal(signal_number, SIG_DFL);
}

}  // namespace

void catch_interruptions() {
  std::signal(SIGINT, remember);
  std::signal(SIGTERM, remember);
}

bool interrupted() { return asked_to_stop != 0; }

}  // namespace acus::app
