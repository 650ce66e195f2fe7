// A flag that becomes true after a time, or as soon as another one does.
#pragma once

#include <atomic>
#include <chrono>
#include <thread>

namespace acus::haptics {

class StopAfter {
 public:
  // `seconds` <= 0: only when `other` says so.
  StopAfter(double seconds, const std::atomic<bool>& other)
      : watching_([this, seconds, &other] { watch(seconds, other); }) {}
  ~StopAfter() {
    left_ = true;
    watching_.join();
  }
  StopAfter(const StopAfter&) = delete;
  StopAfter& operator=(const StopAfter&) = delete;

  const std::atomic<bool>& flag() const { return stop_; }

 private:
  void watch(double seconds, const std::atomic<bool>& other) {
    const auto begin = std::chrono::steady_clock::now();
    const std::chrono::duration<double> all(seconds);
    while (!left_ && !other && (seconds <= 0.0 || std::chrono::steady_clock::now() - begin < all))
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    stop_ = true;
  }

  std::atomic<bool> stop_{false}, left_{false};
  std::thread watching_;  // last: it uses the others
};

}  // namespace acus::haptics
