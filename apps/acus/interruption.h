// Ctrl-C and the polite kill end the work at the next step instead of in the middle of a file.
#pragma once

namespace acus::app {

// From now on SIGINT and SIGTERM only make interrupted() true; a second one ends the program at once.
void catch_interruptions();
bool interrupted();

}  // namespace acus::app
