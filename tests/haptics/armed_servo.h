// A servo with its force on, driven as a loop would, for its tests.
#pragma once

#include <gtest/gtest.h>

#include "acus/haptics/servo.h"

namespace acus::haptics {

inline DeviceLimits touch() { return *find_device_limits("touch"); }

// A servo that has been armed by a quiet simulation, device at rest, and whose hand has done 10 mJ of work
// that may come back: what it takes to stretch the coupling by 7 mm, and to feel 2.8 N.
class Armed {
 public:
  explicit Armed(const DeviceLimits& limits = touch())
      : servo({limits, 0.0, -1e-3, 1e-3}), forward_(limits.forward) {
    for (int i = 0; i < 600; ++i) tick(0.0, fresh(-1e-3, 0.0, 0.0));
    EXPECT_EQ(servo.gate().state(), GateState::armed);
    for (int i = 0; i <= 100; ++i) tick(70e-6 * i, fresh(-1e-3, 3.0, 0.0));
    for (int i = 0; i <= 100; ++i) tick(7e-3 - 70e-6 * i, fresh(-1e-3, 0.0, 0.0));
  }
  LocalForce fresh(double travel, double force, double stiffness, long events = 0) const {
    LocalForce word{time_, travel, force, stiffness, 10e-3, events};
    word.stored = 1.0;
    return word;
  }
  // Force along the needle that the device shows `way` [m] ahead of its start, positive against the hand. N
  double tick(double way, const LocalForce& local, const Vec3& across = Vec3::Zero()) {
    DeviceState state;
    state.time = time_;
    state.position = Vec3(0.03, -0.01, 0.02) + way * forward_ + across;
    state.velocity = velocity;
    state.ready = ready;
    time_ += 1e-3;
    last = servo.tick(state, local).force;
    return -forward_.dot(last);
  }

  Servo servo;
  Vec3 last = Vec3::Zero();
  Vec3 velocity = Vec3::Zero();  // m/s, that the device says
  bool ready = true;

 private:
  Vec3 forward_;
  double time_ = 0.0;
};

}  // namespace acus::haptics
