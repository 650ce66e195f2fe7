// Energy, forces and stiffness of a rod (rod.h), by exact differentiation of its energy.
#pragma once

#include <vector>

#include "acus/needle/rod.h"
#include "acus/numeric/banded.h"

namespace acus::needle {

// A node's bending ties five places and two spins together: eleven unknowns in a row.
inline constexpr int rod_band = 10;
using RodMatrix = numeric::BandedMatrix<rod_band>;

struct RodEnergy {
  double stretch = 0.0;  // J
  double bending = 0.0;  // J; 0 for the unloaded bow
  double twist = 0.0;    // J
};
inline double total(const RodEnergy& e) { return e.stretch + e.bending + e.twist; }

// forces [unknowns] = -dE/d(unknown); N and N m.
// The two poses are read for their directions, where the end is clamped; `tip` may be anything otherwise.
RodEnergy rod_forces_into(std::vector<double>& forces, const Rod& rod, const RodState& state, const Pose& hub,
                          const Pose& tip);

// The same, and matrix += factor * d^2E/d(unknown)^2. What compressed edges and the natural turning take from
// the matrix counts by the share `compression`: 1 makes it the energy's exact slope, which is not definite
// where a rod is about to give way; with 0 it is definite, and an upper bound.
RodEnergy rod_forces_into(std::vector<double>& forces, RodMatrix& matrix, double factor, double compression,
                          const Rod& rod, const RodState& state, const Pose& hub, const Pose& tip);

// Moment that the hub's clamp does on the rod, about node 0. N m
Vec3 hub_moment(const Rod& rod, const RodState& state, const Pose& hub);

}  // namespace acus::needle
