// Simulation: one insertion, advanced a step at a time. No files.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "acus/mesh/tet_mesh.h"
#include "acus/needle/rod.h"
#include "acus/sim/frame.h"
#include "acus/sim/scene.h"
#include "acus/sim/step_probe.h"

namespace acus {

class Simulation {
 public:
  // Builds the model of a scene; `mesh` is the mesh of scene.tissue.mesh in metres (null for a block or
  // rigid). Allocates everything a step will need, and starts all but one of the `threads` that share a step
  // of a large mesh: 1 to most_threads, which is no part of a scene because it changes no bit of a result.
  static Result<Simulation> build(const Scene& scene, const mesh::TetMesh* mesh = nullptr, int threads = 1);

  // Advances one time step; the hand ends it at `hand_travel` [m], and so does the hub unless the scene's
  // grip gives way. Allocates nothing.
  const Frame& step(double hand_travel);

  // The same for a hand that leads in all six degrees of freedom: where it holds the needle (at its hub, or
  // before it by the scene's grip), which way the needle lies in it, and how it is turned about its axis
  // (directions, made unit and across each other; a step turns it by less than a right angle). A pose without
  // directions ends the run as not finite. A column takes the part along the path.
  const Frame& step(const needle::Pose& hub);
  needle::Pose hub() const;  // where the needle is held now

  // How hand_force of the last step would have changed with the hand's travel, N/m: the tangent over one time
  // step, inertia and damping of the tissue included. 0 before the first step. Costs iterations; allocates
  // nothing and leaves the state alone.
  double hand_stiffness();

  // Tells `probe` when each part of a step is done; for benchmarks.
  void set_probe(const StepProbe& probe);

  const Scene& scene() const;
  const Frame& frame() const;
  std::span<const Event> events() const;  // in order of time

  const mesh::TetMesh& tissue() const;      // at rest, ordered for locality; empty when rigid
  std::span<const Vec3> positions() const;  // m, one per node, now
  std::vector<Vec3> velocities() const;     // m/s (computed on call)
  std::vector<double> von_mises() const;    // Pa, one per tetrahedron, now (computed on call)
  // The centre line of the needle now, hub to tip, m: `points` points evenly along its arc.
  std::vector<Vec3> needle_line(int points) const;
  // The same without allocating; `out` has as many entries.
  void von_mises_into(std::span<double> out) const;
  void needle_line_into(std::span<Vec3> out) const;
  Vec3 entry() const;      // m, undeformed
  Vec3 direction() const;  // unit vector into the tissue

  std::uint64_t state_hash() const;

  Simulation(Simulation&&) noexcept;
  Simulation& operator=(Simulation&&) noexcept;
  ~Simulation();

 private:
  struct Parts;
  explicit Simulation(std::unique_ptr<Parts> parts);
  std::unique_ptr<Parts> parts_;
};

}  // namespace acus
