// Whether this thread may count on its millisecond.
#pragma once

#include <string>

namespace acus::haptics {

// Asks for real-time scheduling (SCHED_FIFO) of the calling thread and for memory that is never paged out.
// Empty when granted; else what was refused, and how to be granted it, in one sentence. The loop runs either
// way.
std::string become_real_time();

}  // namespace acus::haptics
