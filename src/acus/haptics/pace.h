// Keeps a loop at its rate: waits for instants on a fixed schedule, so that the time a tick takes does not
// add up.
#pragma once

#include <cstdint>

namespace acus::haptics {

// s, of the clock that never goes back; its origin is of no meaning.
double monotonic_time() noexcept;

class Pace {
 public:
  explicit Pace(double period) noexcept;  // s

  // Sleeps until the next tick is due. Ticks that were missed are left out, not made up for in a burst;
  // returns how many they were.
  long wait() noexcept;

 private:
  std::int64_t period_;  // ns
  std::int64_t due_;     // ns, when the last tick was due
};

}  // namespace acus::haptics
