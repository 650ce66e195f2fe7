// A rod in a testing machine: hub and tip are led, or the tip is pulled, and everything comes to rest.
#pragma once

#include <optional>
#include <vector>

#include "acus/needle/rod_motion.h"

namespace machine {

using namespace acus;
using namespace acus::needle;

// Table I's needle.
inline NeedleSpec table_one(Support support, double imperfection) {
  NeedleSpec spec;
  spec.support = support;
  spec.imperfection = imperfection;
  return spec;
}

// What acts on the tip.
struct Tip {
  Pose pose;                      // where the vice is; its directions count where the rod's tip is clamped
  Mat3 stiffness = Mat3::Zero();  // N/m, of the vice's hold
  Vec3 force{0.0, 0.0, 0.0};      // N, dead load
};

class Machine {
 public:
  Machine(const NeedleSpec& spec, int edges, const Pose& hub)
      : rod(build_rod(spec, edges)),
        state(unloaded_rod(rod, hub)),
        hub_(hub),
        motion_(build_rod_motion(rod)) {}

  // One implicit step; returns Newton's iterations, or nothing when it fails.
  std::optional<int> step(const Pose& hub, const Tip& tip, double h) {
    begin_step(motion_, rod, state, hub, h);
    hub_ = hub;
    for (int pass = 0; pass < 60; ++pass) {
      double compression = 1.0;
      while (!load(hub, tip, h, compression) && compression > 0.0)
        compression = compression > 0.1 ? 0.5 * compression : 0.0;
      motion_.change = motion_.residual;
      motion_.matrix.solve(motion_.change.data());
      double largest = 0.0;
      for (int i = 0; i < rod.unknowns(); ++i)
        if (!is_spin(i)) largest = std::max(largest, std::abs(motion_.change[i]) * h);
      // A long step is cut short.
      const double most = rod.edge_length[0];
      if (largest > most)
        for (double& c : motion_.change) c *= most / largest;
      apply_change(motion_, rod, state, h);
      if (largest < 1e-10) {
        load(hub, tip, h, 1.0);
        hub_force_ = -hub_impulse_ / h;
        return pass + 1;
      }
    }
    return std::nullopt;
  }

  // Steps until nothing moves any more.
  bool rest(const Pose& hub, const Tip& tip, double h) {
    for (int i = 0; i < 400; ++i) {
      const std::vector<Vec3> before = state.position;
      if (!step(hub, tip, h)) return false;
      double largest = 0.0;
      for (int k = 0; k < rod.nodes(); ++k)
        largest = std::max(largest, (state.position[k] - before[k]).norm());
      if (largest < 1e-8) return true;
    }
    return false;
  }

  // N, of the vice and the dead load on the rod.
  Vec3 tip_force(const Tip& tip) const {
    return tip.force + tip.stiffness * (tip.pose.position - state.position.back());
  }
  // N, of the hub on the rod.
  Vec3 hub_force() const { return hub_force_; }
  Vec3 moment_at_hub() const { return hub_moment(rod, state, hub_); }
  const RodEnergy& energy() const { return motion_.energy; }

  Rod rod;
  RodState state;

 private:
  // The system at the iterate, factored; false when it is not definite.
  bool load(const Pose& hub, const Tip& tip, double h, double compression) {
    linearise(motion_, rod, state, hub, tip.pose, h, compression);
    const int at = place_at(rod.edges);
    for (int k = 0; k < 3; ++k) {
      for (int l = 0; l <= k; ++l) motion_.matrix.add(at + k, at + l, h * h * tip.stiffness(k, l));
      motion_.residual[at + k] += h * tip_force(tip)[k];
    }
    hub_impulse_ = Vec3(motion_.residual[0], motion_.residual[1], motion_.residual[2]);
    hold_hub(motion_);
    return motion_.matrix.factor();
  }

  Pose hub_;
  RodMotion motion_;
  Vec3 hub_impulse_{0.0, 0.0, 0.0}, hub_force_{0.0, 0.0, 0.0};
};

}  // namespace machine
