// Whether this thread may count on its millisecond.
#pragma once

#include <string>

namespace acus::haptics {

// As long as it lives: real-time scheduling (SCHED_FIFO) of the thread that made it, and memory that is never
// paged out, as far as they are permitted. The loop runs either way.
class RealTime {
 public:
  RealTime();
  ~RealTime();  // on the same thread
  RealTime(const RealTime&) = delete;
  RealTime& operator=(const RealTime&) = delete;

  // Empty when all was granted; else what was refused, and how to be granted it, in one sentence.
  const std::string& refusal() const { return refusal_; }

 private:
  std::string refusal_;
};

}  // namespace acus::haptics
