// Counts every lock of a mutex of the program, whose one source file includes this.
#pragma once

#include <dlfcn.h>
#include <pthread.h>

namespace {
thread_local long locks = 0;  // of this thread: others may do as they like
}

extern "C" int pthread_mutex_lock(pthread_mutex_t* mutex) noexcept {
  using Lock = int (*)(pthread_mutex_t*);
  static const auto real = reinterpret_cast<Lock>(dlsym(RTLD_NEXT, "pthread_mutex_lock"));
  ++locks;
  return real(mutex);
}
