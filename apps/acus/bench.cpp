// acus bench: what a step costs by mesh size and part, beside a plain reference.
#include <cstdio>
#include <iostream>
#include <nlohmann/json.hpp>

#include "step_cost.h"
#include "verbs.h"

namespace acus::app {
namespace {

nlohmann::ordered_json as_json(const bench::StepCost& cost) {
  nlohmann::ordered_json stages;
  for (int part = 0; part < step_parts; ++part) stages[bench::part_names[part]] = cost.us[part];
  return {{"tetrahedra", cost.tetrahedra},
          {"nodes", cost.nodes},
          {"iterations", cost.iterations},
          {"residual", cost.residual},
          {"residual_of_load", cost.residual_of_load},
          {"us_per_step", cost.us_per_step},
          {"stages", stages},
          {"reference_us_per_step", cost.reference_us_per_step},
          {"reference_residual", cost.reference_residual},
          {"reference_residual_of_load", cost.reference_residual_of_load},
          {"ratio", cost.ratio},
          {"real_time_factor", cost.real_time_factor}};
}

void print_heading() {
  std::printf("%10s %7s %5s %9s %9s |", "tetrahedra", "nodes", "iter.", "residual", "of load");
  for (const char* part : bench::part_names) std::printf(" %8s", part);
  std::printf(" | %9s %9s %9s %9s %6s %6s\n", "us a step", "reference", "residual", "of load", "ratio",
              "x real");
}

void print_row(const bench::StepCost& cost) {
  std::printf("%10d %7d %5.0f %9.1e %9.1e |", cost.tetrahedra, cost.nodes, cost.iterations, cost.residual,
              cost.residual_of_load);
  for (double us : cost.us) std::printf(" %8.0f", us);
  std::printf(" | %9.0f %9.0f %9.1e %9.1e %6.2f %6.2f\n", cost.us_per_step, cost.reference_us_per_step,
              cost.reference_residual, cost.reference_residual_of_load, cost.ratio, cost.real_time_factor);
  std::fflush(stdout);
}

}  // namespace

int do_bench(const BenchOptions& options) {
  nlohmann::ordered_json results = nlohmann::ordered_json::array();
  if (!options.json) print_heading();
  for (int size : options.sizes) {
    const auto equal_by = options.by_load ? bench::EqualBy::load : bench::EqualBy::momentum;
    const Result<bench::StepCost> cost = bench::measure(size, options.steps, equal_by);
    if (!cost) return refused(cost.error().sentence, run_failed);
    if (options.json)
      results.push_back(as_json(*cost));
    else
      print_row(*cost);
  }
  if (options.json)
    std::cout << nlohmann::ordered_json{{"results", results}}.dump(2) << "\n";
  else
    std::printf(
        "A step with needle, contact, cutting and ledger beside a plain Eigen step of the tissue alone (25\n"
        "iterations): medians of processor time taken in turns, the engine solving to the better residual,\n"
        "relative to the momentum or with --by-load to the load.\n");
  return done;
}

}  // namespace acus::app
