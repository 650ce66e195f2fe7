// What a whole insertion costs, step by step: how evenly, and how much time it leaves.
#pragma once

#include <functional>
#include <vector>

#include "acus/base/result.h"
#include "acus/sim/frame.h"
#include "acus/sim/scene.h"

namespace acus::bench {

struct Spread {  // us a step
  double median = 0.0, mean = 0.0, most_99 = 0.0, most_999 = 0.0, worst = 0.0;
};

struct StageCost {
  Stage stage = Stage::free;
  int steps = 0;
  double iterations = 0.0;           // the mean
  double median = 0.0, worst = 0.0;  // us of processor time a step
};

struct InsertionCost {
  int tetrahedra = 0;
  int nodes = 0;
  int steps = 0;
  int threads = 1;
  double time_step = 0.0;         // s
  double simulated = 0.0;         // s
  double iterations = 0.0;        // of conjugate gradients, the mean
  Spread processor, wall;         // of the thread, on the wall if there are several; and always on the wall
  int over = 0, over_wall = 0;    // steps that took longer than the time they advance
  double spare = 0.0;             // share of the step's own time that is left at the median of processor time
  double real_time_factor = 0.0;  // simulated time / processor time of all steps
  double build = 0.0;             // s of processor time before the first step: mesh, model
  double insertions_a_minute = 0.0;  // on one core, each built anew
  std::vector<StageCost> stages;     // in the order in which they were first reached
  std::vector<Event> events;
};

// Follows the hand of the scene to its end; `heard` is told how many steps are done. Error: a scene that
// cannot be built, or an insertion that stopped on its way.
// `threads` share each step.
Result<InsertionCost> measure_insertion(const Scene& scene, const std::function<void(long)>& heard = {},
                                        int threads = 1);

}  // namespace acus::bench
