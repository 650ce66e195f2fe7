// A gate that is driven as a loop would, for its tests.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "acus/haptics/force_gate.h"

namespace acus::haptics {

using Triple = std::array<double, 3>;
inline constexpr double nan = std::numeric_limits<double>::quiet_NaN();
inline constexpr double infinity = std::numeric_limits<double>::infinity();

inline double norm(const Triple& v) { return std::hypot(v[0], v[1], v[2]); }
inline Triple x(double value) { return {value, 0.0, 0.0}; }

// A gate that is asked once a millisecond, as a loop would.
class Driven {
 public:
  explicit Driven(GateLimits limits = {8.5, 3.0, 0.5}) : gate(limits) {}

  Triple ask(const Triple& force, double age = 0.0, const Triple& velocity = {}) {
    return gate.pass({force, {}, velocity, age, 1e-3}).force;
  }
  double ask(double force, double age = 0.0, double speed = 0.0) { return ask(x(force), age, x(speed))[0]; }
  double ask_for(int ticks, double force) {
    double last = 0.0;
    for (int i = 0; i < ticks; ++i) last = ask(force);
    return last;
  }
  // In how many ticks a fault comes; 20 s at most.
  int ask_until_fault(double force) {
    int ticks = 0;
    for (; gate.fault() == GateFault::none && ticks < 20000; ++ticks) ask(force);
    return ticks;
  }
  // Through the quiet ticks and the whole ramp.
  Driven& armed() {
    ask_for(600, 0.0);
    EXPECT_EQ(gate.state(), GateState::armed);
    return *this;
  }
  Driven& at(double force) {
    armed();
    EXPECT_DOUBLE_EQ(ask_for(20, force), force);
    return *this;
  }

  ForceGate gate;
};

}  // namespace acus::haptics
