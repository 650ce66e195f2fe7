// What a step costs, part by part, beside the reference step, in the same minutes on the same core.
#pragma once

#include <array>

#include "acus/base/result.h"
#include "acus/sim/scene.h"
#include "acus/sim/step_probe.h"
#include "residual.h"

namespace acus::bench {

// Times are processor time of the measuring thread, so that other work on the machine does not count; with
// several threads time on the wall, because they wait for each other. Medians.
struct StepCost {
  int tetrahedra = 0;
  int nodes = 0;
  double iterations = 0.0;              // of conjugate gradients, the median
  Residual residual;                    // of the whole coupled step, the medians
  Residual largest_residual;            // the largest seen
  double us_per_step = 0.0;             // the whole step: needle, contact, cutting, ledger
  double mean_us_per_step = 0.0;        // the same, the mean: steps in which the cut jumps take longer
  std::array<double, step_parts> us{};  // by part
  int reference_tetrahedra = 0;
  int reference_nodes = 0;
  double reference_us_per_step = 0.0;  // tissue alone
  Residual reference_residual;         // the medians
  double ratio = 0.0;                  // us_per_step / reference_us_per_step
  double real_time_factor = 0.0;       // simulated time / processor time
};

// By which of the residuals engine and reference are equally good: what is left for each newton of the load,
// which an error of the force goes by; of the equation for the change of velocity; of |b|, the momentum of
// what moves. A block that swings under a sudden newton has much of it and changes much, one into which a
// needle creeps little, so the last two ask more of the engine.
enum class EqualBy { momentum, change, load };

constexpr double Residual::*measure_of(EqualBy equal_by) {
  return equal_by == EqualBy::load     ? &Residual::of_load
         : equal_by == EqualBy::change ? &Residual::of_change
                                       : &Residual::of_momentum;
}

struct StepWanted {
  int tetrahedra = 10000;  // about
  int steps = 100;         // measured
  int threads = 1;         // that share a step of the engine
  EqualBy equal_by = EqualBy::load;
  Element element = TissueScene{}.element;  // of the engine; the reference's are linear
};

// Measures steps of a needle on its way in, 20 mm deep; reference and engine take turns. The engine solves to
// less than the reference's residual.
Result<StepCost> measure(const StepWanted& wanted);

}  // namespace acus::bench
