// The newest value from one thread to another, without waiting on either side: three places, of which the
// writer owns one, the reader one, and the third goes back and forth (a triple buffer).
#pragma once

#include <array>
#include <atomic>
#include <type_traits>

namespace acus::haptics {

// One thread writes, one reads. T is copied, so it must be cheap to copy and allocate nothing.
template <class T>
class NewestValue {
  static_assert(std::is_trivially_copyable_v<T>, "a copy must neither allocate nor throw");

 public:
  explicit NewestValue(const T& first = {}) noexcept { places_.fill(first); }

  // By the writer. Replaces a value that nobody has read.
  void write(const T& value) noexcept {
    places_[writing_] = value;
    writing_ = between_.exchange(writing_ | fresh, std::memory_order_acq_rel) & place;
  }

  // By the reader: the newest value, the same one again where nothing new came.
  const T& read() noexcept {
    if ((between_.load(std::memory_order_relaxed) & fresh) != 0)
      reading_ = between_.exchange(reading_, std::memory_order_acq_rel) & place;
    return places_[reading_];
  }

 private:
  static constexpr unsigned place = 3, fresh = 4;

  std::array<T, 3> places_;
  unsigned writing_ = 0;              // the writer's alone
  alignas(64) unsigned reading_ = 1;  // the reader's alone
  alignas(64) std::atomic<unsigned> between_{2};
};

}  // namespace acus::haptics
