// Who leads the hand or the device: one client at a time, for as long as it says so at least once a second.
#pragma once

#include <mutex>

namespace acus::app {

class Lease {
 public:
  // Takes the lease for `client` (1, 2, ...) at `now` [s], or renews it; false while another has it.
  bool take(long client, double now) {
    const std::lock_guard lock(mutex_);
    if (client != client_ && client_ != nobody && now - renewed_ <= lasts) return false;
    client_ = client;
    renewed_ = now;
    return true;
  }
  // Whether `client` could take it.
  bool is_open_to(long client, double now) const {
    const std::lock_guard lock(mutex_);
    return client == client_ || client_ == nobody || now - renewed_ > lasts;
  }
  // Whoever had it has gone.
  void give_back(long client) {
    const std::lock_guard lock(mutex_);
    if (client == client_) renewed_ = gone;
  }
  // True once after it has run out.
  bool lapsed(double now) {
    const std::lock_guard lock(mutex_);
    if (client_ == nobody || now - renewed_ <= lasts) return false;
    client_ = nobody;
    return true;
  }

 private:
  static constexpr double lasts = 1.0, gone = -1e9;  // s
  static constexpr long nobody = 0;

  mutable std::mutex mutex_;
  long client_ = nobody;
  double renewed_ = gone;  // s
};

}  // namespace acus::app
