// A queue from one thread to one other that never waits: wait-free at both ends, and nothing is allocated
// after it is built.
#pragma once

#include <atomic>
#include <cstddef>
#include <type_traits>
#include <vector>

namespace acus::haptics {

template <class T>
class Ring {
  static_assert(std::is_trivially_copyable_v<T>);
  static_assert(std::atomic<std::size_t>::is_always_lock_free);

 public:
  // Holds at least `least` things: the next power of two.
  explicit Ring(std::size_t least) {
    std::size_t capacity = 1;
    while (capacity < least) capacity *= 2;
    slots_.resize(capacity);
  }

  std::size_t capacity() const noexcept { return slots_.size(); }
  // As seen from either thread; from the pushing one, no fewer are free.
  std::size_t size() const noexcept {
    return pushed_.load(std::memory_order_acquire) - popped_.load(std::memory_order_acquire);
  }

  // False, and nothing done, when it is full. For the one thread that pushes.
  bool push(const T& thing) noexcept {
    const std::size_t at = pushed_.load(std::memory_order_relaxed);
    if (at - popped_.load(std::memory_order_acquire) == slots_.size()) return false;
    slots_[at & (slots_.size() - 1)] = thing;
    pushed_.store(at + 1, std::memory_order_release);
    return true;
  }

  // False when it is empty. For the one thread that pops.
  bool pop(T& thing) noexcept {
    const std::size_t at = popped_.load(std::memory_order_relaxed);
    if (at == pushed_.load(std::memory_order_acquire)) return false;
    thing = slots_[at & (slots_.size() - 1)];
    popped_.store(at + 1, std::memory_order_release);
    return true;
  }

 private:
  static constexpr std::size_t cache_line =
      64;  // bytes; each counter on its own, or the threads slow each other

  std::vector<T> slots_;
  alignas(cache_line) std::atomic<std::size_t> pushed_{0};  // ever; written by the one thread
  alignas(cache_line) std::atomic<std::size_t> popped_{0};  // ever; written by the other
};

}  // namespace acus::haptics
