#include "insertion_cost.h"

#include <algorithm>
#include <string>

#include "acus/sim/hand.h"
#include "acus/sim/simulation.h"
#include "acus/sim/summary.h"
#include "measuring.h"

namespace acus::bench {
namespace {

constexpr double us = 1e-6;  // s

struct Samples {
  std::vector<double> processor, wall;  // us
  std::vector<Stage> stage;             // at the end of the step
  std::vector<double> iterations;
};

Samples follow_hand(Simulation& simulation, const std::function<void(long)>& heard, int threads) {
  const auto clock = clock_for(threads);
  const Scene& scene = simulation.scene();
  Hand hand(scene.hand, scene.run.time_step);
  Samples samples;
  while (simulation.frame().health == Health::good) {
    const std::optional<double> travel = hand.next(simulation.frame().hand_force);
    if (!travel) break;
    const std::int64_t wall = wall_clock(), begun = clock();
    const Frame& frame = simulation.step(*travel);
    samples.processor.push_back(us_between(begun, clock()));
    samples.wall.push_back(us_between(wall, wall_clock()));
    samples.stage.push_back(frame.stage);
    samples.iterations.push_back(frame.solver_iterations);
    if (heard) heard(static_cast<long>(samples.processor.size()));
  }
  return samples;
}

Spread spread(const std::vector<double>& values) {
  return {median(values), mean(values), quantile(values, 0.99), quantile(values, 0.999),
          quantile(values, 1.0)};
}

int count_over(const std::vector<double>& values, double limit) {
  return static_cast<int>(std::count_if(values.begin(), values.end(), [&](double v) { return v > limit; }));
}

StageCost cost_of(Stage stage, const Samples& samples) {
  std::vector<double> us_of, iterations_of;
  for (std::size_t i = 0; i < samples.stage.size(); ++i) {
    if (samples.stage[i] != stage) continue;
    us_of.push_back(samples.processor[i]);
    iterations_of.push_back(samples.iterations[i]);
  }
  return {stage, static_cast<int>(us_of.size()), mean(iterations_of), median(us_of), quantile(us_of, 1.0)};
}

std::vector<StageCost> by_stage(const Samples& samples) {
  std::vector<StageCost> all;
  for (Stage stage : samples.stage)
    if (std::none_of(all.begin(), all.end(), [&](const StageCost& c) { return c.stage == stage; }))
      all.push_back(cost_of(stage, samples));
  return all;
}

}  // namespace

Result<InsertionCost> measure_insertion(const Scene& scene, const std::function<void(long)>& heard,
                                        int threads) {
  const std::int64_t begun = processor_clock();
  Result<Simulation> simulation = Simulation::build(scene, nullptr, threads);
  if (!simulation) return simulation.error();
  InsertionCost cost;
  cost.build = us * us_between(begun, processor_clock());
  const Samples samples = follow_hand(*simulation, heard, threads);
  if (simulation->frame().health != Health::good)
    return Error{"the insertion stopped after " + std::to_string(simulation->frame().time) +
                 " s of its time: " + complaint(simulation->frame().health)};
  if (samples.processor.empty())
    return Error{"the hand of this insertion takes no step; raise hand.travel_mm"};

  cost.tetrahedra = static_cast<int>(simulation->tissue().tets.size());
  cost.nodes = static_cast<int>(simulation->tissue().nodes.size());
  cost.steps = static_cast<int>(samples.processor.size());
  cost.time_step = scene.run.time_step;
  cost.simulated = cost.steps * cost.time_step;
  cost.iterations = mean(samples.iterations);
  cost.processor = spread(samples.processor);
  cost.wall = spread(samples.wall);
  const double own_time = cost.time_step / us;
  cost.over = count_over(samples.processor, own_time);
  cost.over_wall = count_over(samples.wall, own_time);
  cost.spare = 1.0 - cost.processor.median / own_time;
  const double all = us * sum(samples.processor);  // s
  cost.real_time_factor = cost.simulated / all;
  constexpr double minute = 60.0;  // s
  cost.threads = threads;
  cost.insertions_a_minute = minute / (cost.build + all) / threads;
  cost.stages = by_stage(samples);
  cost.events.assign(simulation->events().begin(), simulation->events().end());
  return cost;
}

}  // namespace acus::bench
