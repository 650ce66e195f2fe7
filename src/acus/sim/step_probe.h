// Hears how a step proceeds.
#pragma once

namespace acus {

// The parts of a step, in order; a probe is told when each is done (benchmarks time them, a step reads no
// clock).
enum class StepPart { touch, assembly, solve, rotation, cutting, ledger };
inline constexpr int step_parts = 6;
struct StepProbe {
  void (*done)(void* self, StepPart part) = nullptr;
  void* self = nullptr;
  void operator()(StepPart part) const {
    if (done) done(self, part);
  }
};

}  // namespace acus
