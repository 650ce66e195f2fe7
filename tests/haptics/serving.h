// For tests of devices: a device that is served on a thread, and ticks that a test can look into.
#pragma once

#include <dlfcn.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <string>
#include <thread>

#include "acus/haptics/device.h"

namespace acus::haptics {

// The symbol of a driver's emulator, which the device under test has loaded or will load.
template <class Function>
Function* emulator_function(const std::string& path, const char* symbol) {
  void* library = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (!library) ADD_FAILURE() << dlerror();
  return library ? reinterpret_cast<Function*>(dlsym(library, symbol)) : nullptr;
}

// Generous, for slow machines: a test that gets this far has failed anyway.
template <class Condition>
bool wait_for(Condition condition) {
  for (int ms = 0; ms < 60'000; ++ms) {
    if (condition()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return false;
}

inline void expect_one_sentence_with(const std::string& text, const std::string& part) {
  EXPECT_NE(text.find(part), std::string::npos) << text;
  EXPECT_EQ(text.find('\n'), std::string::npos) << text;
}

class Serving {
 public:
  Serving(Device& device, Tick& tick)
      : thread_([this, &device, &tick] {
          lost_ = device.serve(tick, stop_);
          over_ = true;
        }) {}
  ~Serving() {
    if (thread_.joinable()) stop();
  }

  bool over() const { return over_; }
  std::optional<Error> stop() {
    stop_ = true;
    thread_.join();
    return lost_;
  }
  // How it ended by itself.
  std::string loss() {
    EXPECT_TRUE(wait_for([this] { return over(); }));
    const std::optional<Error> lost = stop();
    return lost ? lost->sentence : "";
  }

 private:
  std::atomic<bool> stop_{false}, over_{false};
  std::optional<Error> lost_;
  std::thread thread_;
};

// The same wrench whatever the device says; what it said is kept, to be read when it is served no more.
class Steady final : public Tick {
 public:
  explicit Steady(const Vec3& force = Vec3::Zero(), const Vec3& torque = Vec3::Zero())
      : wrench_{force, torque} {}
  Wrench operator()(const DeviceState& state) noexcept override {
    time_goes_on = time_goes_on && (calls == 0 || state.time > last.time);
    last = state;
    ++calls;
    return wrench_;
  }
  std::atomic<long> calls{0};
  DeviceState last;
  bool time_goes_on = true;

 private:
  Wrench wrench_;
};

class Spring final : public Tick {
 public:
  Spring(double stiffness, const Vec3& anchor) : stiffness_(stiffness), anchor_(anchor) {}
  Wrench operator()(const DeviceState& state) noexcept override {
    return {stiffness_ * (anchor_ - state.position), Vec3::Zero()};
  }

 private:
  double stiffness_;  // N/m
  Vec3 anchor_;       // m
};

}  // namespace acus::haptics
