#include "acus/haptics/real_time.h"

#include <pthread.h>
#include <sched.h>
#include <sys/mman.h>

namespace acus::haptics {

RealTime::RealTime() {
  constexpr int priority = 80;  // of 1 to 99: above what a desktop runs, below the kernel's own threads
  sched_param parameters{};
  parameters.sched_priority = priority;
  if (pthread_setschedparam(pthread_self(), SCHED_FIFO, &parameters) != 0)
    refusal_ =
        "not real time: this user may not have real-time scheduling; a line '@realtime - rtprio 95' in "
        "/etc/security/limits.conf and membership in that group allow it";
  else if (mlockall(MCL_CURRENT | MCL_FUTURE) != 0)
    refusal_ =
        "not real time: memory may be paged out; a line '@realtime - memlock unlimited' in "
        "/etc/security/limits.conf and membership in that group prevent it";
}

RealTime::~RealTime() {
  munlockall();
  const sched_param ordinary{};
  pthread_setschedparam(pthread_self(), SCHED_OTHER, &ordinary);
}

}  // namespace acus::haptics
