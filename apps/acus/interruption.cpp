#include "interruption.h"

#include <csignal>

namespace acus::app {
namespace {

// Written by the handler of a signal and read by every thread: only an atomic without a lock may be both.
std::atomic<bool> asked_to_stop{false};
static_assert(std::atomic<bool>::is_always_lock_free);

void remember(int signal_number) {
  asked_to_stop = true;
  std::signal(signal_number, SIG_DFL);
}

}  // namespace

void catch_interruptions() {
  std::signal(SIGINT, remember);
  std::signal(SIGTERM, remember);
}

bool interrupted() { return asked_to_stop; }

const std::atomic<bool>& interruption_flag() { return asked_to_stop; }

}  // namespace acus::app
