// acus bench: what a step costs by mesh size and part, beside a plain reference; or what a whole insertion
// costs.
#include <cstdio>
#include <iostream>
#include <nlohmann/json.hpp>

#include "acus/io/scene_toml.h"
#include "acus/sim/names.h"
#include "bench_insertion.h"
#include "reference_step.h"
#include "step_cost.h"
#include "verbs.h"

namespace acus::app {
namespace {

using Json = nlohmann::ordered_json;

void add_residual(Json& json, const std::string& prefix, const bench::Residual& residual) {
  json[prefix + "residual"] = residual.of_momentum;
  json[prefix + "residual_of_change"] = residual.of_change;
  json[prefix + "residual_of_load"] = residual.of_load;
}

// Whether the engine's largest residual stays below the reference's median, by the measure that is wanted.
bool is_met(const bench::StepCost& cost, bench::EqualBy equal_by) {
  const auto quantity = bench::measure_of(equal_by);
  return cost.largest_residual.*quantity <= cost.reference_residual.*quantity;
}

Json as_json(const bench::StepCost& cost, const bench::StepWanted& wanted, const std::string& equal) {
  Json json = {{"tetrahedra", cost.tetrahedra},
               {"nodes", cost.nodes},
               {"threads", wanted.threads},
               {"element", wanted.element == Element::linear ? "linear" : "nodal_pressure"},
               {"equal", equal},
               {"equal_is_met", is_met(cost, wanted.equal_by)},
               {"iterations", cost.iterations}};
  add_residual(json, "", cost.largest_residual);
  add_residual(json, "median_", cost.residual);
  json["us_per_step"] = cost.us_per_step;
  json["mean_us_per_step"] = cost.mean_us_per_step;
  for (int part = 0; part < step_parts; ++part)
    json["stages"][name_of(static_cast<StepPart>(part))] = cost.us[part];
  json["reference_tetrahedra"] = cost.reference_tetrahedra;
  json["reference_nodes"] = cost.reference_nodes;
  json["reference_us_per_step"] = cost.reference_us_per_step;
  add_residual(json, "reference_", cost.reference_residual);
  json["ratio"] = cost.ratio;
  json["real_time_factor"] = cost.real_time_factor;
  return json;
}

void print_heading() {
  std::printf("%-10s %10s %7s %5s %9s %9s %9s %9s %6s %6s\n", "", "tetrahedra", "nodes", "iter.", "us a step",
              "residual", "of change", "of load", "ratio", "x real");
}

void print_line(const char* what, int tetrahedra, int nodes, double iterations, double us,
                const bench::Residual& residual) {
  std::printf("%-10s %10d %7d %5.0f %9.0f %9.1e %9.1e %9.1e", what, tetrahedra, nodes, iterations, us,
              residual.of_momentum, residual.of_change, residual.of_load);
}

void print_row(const bench::StepCost& cost) {
  print_line("acus", cost.tetrahedra, cost.nodes, cost.iterations, cost.us_per_step, cost.residual);
  std::printf(" %6.2f %6.2f\n", cost.ratio, cost.real_time_factor);
  print_line("reference", cost.reference_tetrahedra, cost.reference_nodes, bench::reference_iterations,
             cost.reference_us_per_step, cost.reference_residual);
  std::printf("\n%-10s", "  of which");
  for (int part = 0; part < step_parts; ++part)
    std::printf(" %s %.0f,", name_of(static_cast<StepPart>(part)).c_str(), cost.us[part]);
  std::printf(" mean of the whole %.0f us\n", cost.mean_us_per_step);
  std::fflush(stdout);
}

int measure_steps(const BenchOptions& options) {
  Json results = Json::array();
  if (!options.json) print_heading();
  std::string missed;  // tetrahedra
  bench::StepWanted wanted;
  wanted.steps = options.steps;
  wanted.threads = options.threads;
  if (!options.element.empty())
    wanted.element = io::with_settings({}, {"tissue.element=" + options.element})->tissue.element;
  wanted.equal_by = options.equal == "load"     ? bench::EqualBy::load
                    : options.equal == "change" ? bench::EqualBy::change
                                                : bench::EqualBy::momentum;
  for (int size : options.sizes) {
    wanted.tetrahedra = size;
    const Result<bench::StepCost> cost = bench::measure(wanted);
    if (!cost) return refused(cost.error().sentence, run_failed);
    if (options.json)
      results.push_back(as_json(*cost, wanted, options.equal));
    else
      print_row(*cost);
    if (!is_met(*cost, wanted.equal_by)) missed.append(" ").append(std::to_string(cost->tetrahedra));
  }
  if (options.json)
    std::cout << Json{{"results", results}}.dump(2) << "\n";
  else
    std::printf(
        "A step with needle, contact, cutting and ledger beside a plain Eigen step of linear tissue alone:\n"
        "medians of %s time taken in turns, and medians of the residuals. The engine solves so that its\n"
        "largest residual stays below the reference's median by the measure that --equal names, %s%s%s.\n",
        options.threads > 1 ? "wall" : "processor", options.equal.c_str(),
        missed.empty() ? "" : "; it did not at", missed.c_str());
  return done;
}

}  // namespace

int do_bench(const BenchOptions& options) {
  if (options.insertion) return measure_insertions(options);
  if (!options.settings.empty())
    return refused("--set lays a value over the scene of a whole insertion; add --insertion", bad_input);
  return measure_steps(options);
}

}  // namespace acus::app
