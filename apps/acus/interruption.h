// Ctrl-C and the polite kill end the work at the next step instead of in the middle of a file.
#pragma once

#include <atomic>

namespace acus::app {

// From now on SIGINT and SIGTERM only make interrupted() true; a second one ends the program at once.
void catch_interruptions();
bool interrupted();
// The same, for threads that watch it.
const std::atomic<bool>& interruption_flag();

}  // namespace acus::app
