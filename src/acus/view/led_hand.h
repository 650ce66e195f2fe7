// The hand that a page leads: it rests, glides to where it is pushed, or goes on steadily.
#pragma once

#include "acus/sim/scene.h"

namespace acus::view {

class LedHand {
 public:
  LedHand() = default;
  // Rests where the scene's own hand begins.
  explicit LedHand(const Scene& scene);

  void push(double travel);   // m
  void steady(double speed);  // m/s
  // Where it is one step of `time_step` [s] later. m from first touch
  double advance(double time_step);
  double travel() const { return travel_; }

 private:
  // It may pull the needle out by its length, and push until as little is left outside as a scene allows.
  double least_ = 0.0, most_ = 0.0;  // m
  double fastest_ = 0.0;             // m/s, of a push
  double travel_ = 0.0;              // m
  double target_ = 0.0;              // m, while it is pushed
  double speed_ = 0.0;               // m/s, while it goes on steadily
  bool pushed_ = false;
};

}  // namespace acus::view
