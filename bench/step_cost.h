// What a step costs, part by part, beside the reference step, in the same minutes on the same core.
#pragma once

#include <array>

#include "acus/base/result.h"
#include "acus/sim/step_probe.h"

namespace acus::bench {

inline constexpr std::array<const char*, step_parts> part_names = {"touch",    "assembly", "solve",
                                                                   "rotation", "cutting",  "ledger"};

// Times are processor time of the measuring thread, so that other work on the machine does not count;
// medians.
struct StepCost {
  int tetrahedra = 0;
  int nodes = 0;
  double iterations = 0.0;              // of conjugate gradients
  double residual = 0.0;                // |b - A v| / |b| of the whole coupled step, the largest seen
  double residual_of_load = 0.0;        // |b - A v| / h per newton of all contacts, the largest seen
  double us_per_step = 0.0;             // the whole step: needle, contact, cutting, ledger
  std::array<double, step_parts> us{};  // by part
  double reference_us_per_step = 0.0;   // tissue alone
  double reference_residual = 0.0;      // the same definitions, the median
  double reference_residual_of_load = 0.0;
  double ratio = 0.0;             // us_per_step / reference_us_per_step
  double real_time_factor = 0.0;  // simulated time / processor time
};

// By which of the two residuals engine and reference are equally good. |b| is the momentum of what moves: a
// block that swings under a sudden newton has much, one into which a needle creeps has little, so that the
// first asks for more of the engine than the second, which is what an error of the force goes by.
enum class EqualBy { momentum, load };

// Measures `steps` steps of a needle on its way in, 20 mm deep, in a block of about `tetrahedra`; reference
// and engine take turns. The engine solves to less than the reference's residual.
Result<StepCost> measure(int tetrahedra, int steps, EqualBy equal_by);

}  // namespace acus::bench
