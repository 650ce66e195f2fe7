// Counts every operator new of the program, whose one source file includes this, and the bytes that it holds.
#pragma once

#include <gtest/gtest.h>
#include <malloc.h>

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <new>

namespace {
// Of this thread: others may do as they like.
thread_local long allocations = 0;
thread_local long live_bytes = 0;  // without what was allocated by others and freed here
thread_local long most_live_bytes = 0;
std::atomic<long> allocations_of_all{0};  // of all threads

inline void* counted(void* memory) {
  ++allocations;
  ++allocations_of_all;
  live_bytes += static_cast<long>(malloc_usable_size(memory));  // 0 of none
  most_live_bytes = std::max(most_live_bytes, live_bytes);
  return memory;
}
inline void release(void* memory) {
  live_bytes -= static_cast<long>(malloc_usable_size(memory));
  std::free(memory);
}
}  // namespace

// Not inlined, lest the compiler see a free for a new and warn of it.
[[gnu::noinline]] void* operator new(std::size_t size) {
  if (void* memory = counted(std::malloc(size ? size : 1))) return memory;
  throw std::bad_alloc();
}
[[gnu::noinline]] void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  return counted(std::malloc(size ? size : 1));
}
[[gnu::noinline]] void* operator new(std::size_t size, std::align_val_t alignment) {
  const auto a = static_cast<std::size_t>(alignment);
  if (void* memory = counted(std::aligned_alloc(a, (size + a - 1) / a * a))) return memory;
  throw std::bad_alloc();
}
[[gnu::noinline]] void operator delete(void* memory) noexcept { release(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept { release(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::align_val_t) noexcept { release(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::size_t, std::align_val_t) noexcept {
  release(memory);
}

TEST(CountedAllocations, are_seen_by_this_program) {
  const long before = allocations;
  ::operator delete(::operator new(1000));  // called by name, so that no compiler may leave it out
  EXPECT_EQ(allocations, before + 1);

  const long held = live_bytes;
  void* memory = ::operator new(1000);
  EXPECT_GE(live_bytes, held + 1000);
  EXPECT_GE(most_live_bytes, live_bytes);
  ::operator delete(memory);
  EXPECT_EQ(live_bytes, held);
}
