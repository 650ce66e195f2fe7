#include "acus/haptics/pace.h"

#include <cassert>
#include <cerrno>
#include <cmath>
#include <ctime>

namespace acus::haptics {
namespace {

constexpr std::int64_t second = 1'000'000'000;  // ns

std::int64_t now() noexcept {
  timespec time{};
  clock_gettime(CLOCK_MONOTONIC, &time);
  return time.tv_sec * second + time.tv_nsec;
}

}  // namespace

double monotonic_time() noexcept { return static_cast<double>(now()) / static_cast<double>(second); }

Pace::Pace(double period) noexcept
    : period_(std::llround(period * static_cast<double>(second))), due_(now()) {
  assert(period_ > 0);
}

long Pace::wait() noexcept {
  const std::int64_t behind = now() - due_;
  const std::int64_t missed = behind >= period_ ? behind / period_ : 0;
  due_ += (missed + 1) * period_;
  const timespec until{due_ / second, due_ % second};
  while (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &until, nullptr) == EINTR) {
  }
  return missed;
}

}  // namespace acus::haptics
