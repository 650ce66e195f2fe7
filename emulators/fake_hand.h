// An emulator's hand: a mass that a spring and a damper hold to a target, and the target glides to where it
// is sent. It knows nothing of acus.
#pragma once

#include <array>
#include <cmath>
#include <cstdlib>

struct FakeHand {
  using Triple = std::array<double, 3>;

  double mass = 0.3;                                // kg
  double stiffness = 150.0;                         // N/m
  double damping = 20.0;                            // N s/m
  double target_speed = 0.3;                        // m/s
  Triple goal{}, target{}, position{}, velocity{};  // m, m/s
  bool tries = false;                               // a needle, by itself
  Triple forward{};                                 // unit vector, away from the person
  double time = 0.0;                                // s

  // Where ACUS_EMULATED_HAND is set, somebody tries a needle: after a second 40 mm forward, then back.
  void wake_up(const Triple& away) {
    if (std::getenv("ACUS_EMULATED_HAND") == nullptr) return;
    tries = true;
    forward = away;
    target_speed = 0.02;
  }

  // In steps that are short for any device; `force` is what the device puts on the hand, in N.
  void move(const Triple& force, double elapsed) {
    time += elapsed;
    if (tries) {
      constexpr double begins = 1.0, turns = 4.0, depth = 0.04;  // s, s, m
      for (std::size_t i = 0; i < 3; ++i) goal[i] = time > begins && time < turns ? depth * forward[i] : 0.0;
    }
    constexpr int steps = 10;
    const double dt = elapsed / steps;
    for (int step = 0; step < steps; ++step) {
      glide(target_speed * dt);
      for (std::size_t i = 0; i < 3; ++i) {
        const double pull = stiffness * (target[i] - position[i]) - damping * velocity[i] + force[i];
        velocity[i] += pull / mass * dt;
        position[i] += velocity[i] * dt;
      }
    }
  }

 private:
  void glide(double reach) {
    const Triple way = {goal[0] - target[0], goal[1] - target[1], goal[2] - target[2]};
    const double length = std::hypot(way[0], way[1], way[2]);
    const double share = length <= reach ? 1.0 : reach / length;
    for (std::size_t i = 0; i < 3; ++i) target[i] += share * way[i];
  }
};
