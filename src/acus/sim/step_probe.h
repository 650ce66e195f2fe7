// Hears how a step proceeds.
#pragma once

namespace acus {

// The parts of a step (names.h has the words). A probe is told whenever a stretch of one is done: what came
// since the last call belongs to it. Some parts alternate, so that a step's share of a part is the sum of its
// stretches. (Benchmarks time them, a step reads no clock.)
enum class StepPart {
  contact,   // laying the needle over its channel, and listing what can hold it there
  assembly,  // momentum, matrix, and the one product that tells how good the start is
  rod,       // the needle's own: linearised, factored, solved, checked; of a column its balanced rate
  coupling,  // what the contacts add to the equations, their branches, the search along a step
  solve,     // the tissue's conjugate gradients; each product has the answer of the rod in it
  rotation,  // positions, rotations, elastic forces
  cutting,   // the contacts carried out, and the cut going on
  ledger     // energies, stage, frame, and what the next step starts from
};
inline constexpr int step_parts = 8;
struct StepProbe {
  void (*done)(void* self, StepPart part) = nullptr;
  void* self = nullptr;
  void operator()(StepPart part) const {
    if (done) done(self, part);
  }
};

}  // namespace acus
