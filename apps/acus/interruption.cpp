#include "interruption.h"

#include <csignal>

namespace acus::app {
namespace {

volatile std::sig_atomic_t asked_to_stop = 0;

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
