// A spring in series with a slider: the one law behind tip contact, rupture, cutting and dry friction.
//
// With elongation e, the force is k e, held within [lower, upper]; when a step of relative sliding s would
// take it past a bound, the slider gives way and the rest is slip (return mapping; Simo and Hughes 1998, ch.
// 1). The step is implicit, so that it is unconditionally stable and never gives energy back:
//   f (e1 - e0 + slip) = k e1^2 / 2 - k e0^2 / 2  +  f slip  +  k (e1 - e0)^2 / 2.
#pragma once

#include <utility>

namespace acus::coupling {

// Which branch a step takes. `open`: a contact (lower = 0) that is not touching; its elongation is minus the
// gap.
enum class Grip { open, stick, slip_forward, slip_back };

struct Slider {
  double stiffness = 0.0;   // k, N/m
  double elongation = 0.0;  // e, m
  double lower = 0.0;       // N, at most 0
  double upper = 0.0;       // N, at least 0
  bool unilateral = false;  // a contact: below zero force it opens instead of slipping back
};

// The branch that relative sliding `s` [m] of the needle against the tissue leads to.
inline Grip grip_after(const Slider& slider, double s) {
  const double trial = slider.stiffness * (slider.elongation + s);
  if (trial > slider.upper) return Grip::slip_forward;
  if (trial >= slider.lower) return Grip::stick;
  return slider.unilateral ? Grip::open : Grip::slip_back;
}

// On a branch the force is constant + rate * s.
struct LinearForce {
  double constant = 0.0;  // N
  double rate = 0.0;      // N/m
};
inline LinearForce force_on(const Slider& slider, Grip grip) {
  switch (grip) {
    case Grip::stick:
      return {slider.stiffness * slider.elongation, slider.stiffness};
    case Grip::slip_forward:
      return {slider.upper, 0.0};
    case Grip::slip_back:
      return {slider.lower, 0.0};
    case Grip::open:
      break;
  }
  return {};
}

struct SliderStep {
  double force = 0.0;       // N
  double elongation = 0.0;  // m, after the step
  double slip = 0.0;        // m, signed
  double dissipated = 0.0;  // J, force times slip
  double numerical = 0.0;   // J, lost by the implicit step
  double released = 0.0;    // J, that the spring let go because its bound had fallen, as at a puncture
};

// What the sliders of a needle did in a step.
struct NeedleSlide {
  SliderStep tip;            // along its own axis
  double shaft_force = 0.0;  // N, along the path, of the tissue on the shaft behind the tip
};

// Elastic energy of the spring, J; an open contact stores none.
inline double stored_energy(const Slider& slider, double elongation) {
  if (slider.unilateral && elongation < 0.0) return 0.0;
  return 0.5 * slider.stiffness * elongation * elongation;
}

// Carries out the step whatever branch it takes. The bounds always hold.
inline SliderStep advance(const Slider& slider, double s) {
  SliderStep step;
  const Grip grip = grip_after(slider, s);
  const LinearForce force = force_on(slider, grip);
  step.force = force.constant + force.rate * s;
  step.elongation = slider.elongation + s;
  if (grip == Grip::slip_forward || grip == Grip::slip_back) step.elongation = step.force / slider.stiffness;
  if (grip != Grip::open) step.slip = slider.elongation + s - step.elongation;
  step.dissipated = step.force * step.slip;
  step.numerical = step.force * s - step.dissipated - stored_energy(slider, step.elongation) +
                   stored_energy(slider, slider.elongation);
  if (grip == Grip::slip_forward && slider.stiffness * slider.elongation > slider.upper)
    std::swap(step.numerical, step.released);  // however short the step
  return step;
}

}  // namespace acus::coupling
