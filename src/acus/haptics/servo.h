// One tick of the haptic loop, whole: from where the device is to what it shows, and how far the hand has
// come. No thread and no clock: the same code runs under a driver's callback, in a paced loop, and in the
// virtual time of the proofs.
#pragma once

#include "acus/haptics/device.h"
#include "acus/haptics/force_gate.h"
#include "acus/haptics/hold_damper.h"
#include "acus/haptics/local_force.h"
#include "acus/haptics/passivity_layer.h"
#include "acus/haptics/virtual_coupling.h"

namespace acus::haptics {

struct ServoSettings {
  DeviceLimits limits;
  double force_limit = 0.0;   // N, the person's own; 0: the device's
  double start_travel = 0.0;  // m, of the hand where the device is when it first becomes ready
  double period = 1e-3;       // s, of a tick
};

class Servo {
 public:
  explicit Servo(const ServoSettings& settings);

  // What the device shall show, in its own frame. `local` is the newest word of the simulation; its age is
  // counted on the device's clock. Allocates nothing.
  Wrench tick(const DeviceState& device, const LocalForce& local) noexcept;

  // Where the hand is, for the simulation.
  HandMotion hand() const { return {hand_travel_, passivity_.work(), passivity_.felt_work()}; }
  const VirtualCoupling& coupling() const { return coupling_; }
  const ForceGate& gate() const { return gate_; }
  void rearm() noexcept { gate_.rearm(); }
  // From the next tick on the force falls to nothing, and stays there.
  void let_go() noexcept { let_go_ = true; }
  // In how many ticks the force was lowered lest it give energy away.
  long lowered() const { return lowered_ + gate_.interventions().ceiling; }

 private:
  void place(const DeviceState& device) noexcept;
  double across(const Vec3& force) const noexcept;
  double felt_along(double needle, double drag, double step, double speed, double age) noexcept;
  LocalForce blended(LocalForce local, double now) noexcept;

  VirtualCoupling coupling_;
  ForceGate gate_;
  PassivityLayer passivity_;
  HoldDamper hold_damper_;
  double answered_ = 0.0;  // N, of the shown force, by the damper of the hold: what it takes is not stored
  double period_;          // s
  Vec3 forward_;
  double start_travel_;
  double hand_travel_;
  bool placed_ = false;  // the device is ready, and its place known
  bool let_go_ = false;
  long lowered_ = 0;
  Vec3 origin_ = Vec3::Zero(), way_ = Vec3::Zero();  // m, of the device where it was placed, and from there
  double last_tick_ = 0.0;                           // s
  Vec3 position_ = Vec3::Zero(), shown_ = Vec3::Zero();  // of the last tick, m and N
  LocalForce known_;                                     // what was last blended in
  double offset_ = 0.0;  // N, from the known force to the one that was shown when it came
  double blend_from_ = 0.0, blend_time_ = 0.0;  // s
};

}  // namespace acus::haptics
