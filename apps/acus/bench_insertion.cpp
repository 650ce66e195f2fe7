#include "bench_insertion.h"

#include <algorithm>
#include <cstdio>
#include <iostream>
#include <nlohmann/json.hpp>
#include <string_view>

#include "acus/base/units.h"
#include "acus/io/insertion.h"
#include "acus/io/scene_toml.h"
#include "acus/sim/names.h"
#include "acus/view/offered_scenes.h"
#include "insertion_cost.h"
#include "progress.h"

namespace acus::app {
namespace {

using Json = nlohmann::ordered_json;

const char* default_scene() {
  const auto* found =
      std::find_if(std::begin(view::offered_scenes), std::end(view::offered_scenes),
                   [](const auto& scene) { return std::string_view(scene.name) == "default"; });
  return found->toml;
}

// A steady hand comes from above the tissue, goes in as far as it would, and out again at the same speed.
void draw_out_again(HandScene& hand) {
  if (hand.kind != HandKind::steady) return;
  constexpr double clearance = 5e-3;  // m
  const double way = (hand.travel + clearance) / hand.speed;
  hand.path = {{0.0, -clearance}, {way, hand.travel}, {2.0 * way, -clearance}};
  hand.kind = HandKind::path;
}

Result<Scene> scene_for(const BenchOptions& options, int tetrahedra) {
  std::vector<std::string> settings = options.settings;
  if (!options.element.empty()) settings.push_back("tissue.element=" + options.element);
  Result<Scene> scene = io::parse_scene(default_scene(), "scenes/default.toml", settings);
  if (!scene) return scene;
  if (!scene->tissue.mesh.empty())
    return Error{"tissue.mesh: what is measured is a block of --sizes tetrahedra; leave the mesh away"};
  scene->tissue.tetrahedra = tetrahedra;
  draw_out_again(scene->hand);
  return validated(*scene);
}

Json as_json(const bench::Spread& spread) {
  return {{"median", spread.median},
          {"mean", spread.mean},
          {"p99", spread.most_99},
          {"p99_9", spread.most_999},
          {"worst", spread.worst}};
}

Json as_json(const bench::InsertionCost& cost, const Scene& scene) {
  Json stages, events = Json::array();
  for (const bench::StageCost& c : cost.stages)
    stages[name_of(c.stage)] = {
        {"steps", c.steps}, {"iterations", c.iterations}, {"median", c.median}, {"worst", c.worst}};
  for (const Event& event : cost.events)
    events.push_back({{"time_s", event.time}, {"event", name_of(event.kind)}});
  return {{"tetrahedra", cost.tetrahedra},
          {"nodes", cost.nodes},
          {"iterations", cost.iterations},
          {"insertion",
           {{"solver_tolerance", scene.run.solver_tolerance},
            {"time_step_ms", cost.time_step / units::ms},
            {"steps", cost.steps},
            {"threads", cost.threads},
            {"simulated_s", cost.simulated},
            {"processor_us", as_json(cost.processor)},
            {"wall_us", as_json(cost.wall)},
            {"steps_over", cost.over},
            {"steps_over_wall", cost.over_wall},
            {"spare_at_median", cost.spare},
            {"real_time_factor", cost.real_time_factor},
            {"build_s", cost.build},
            {"insertions_a_minute_a_core", cost.insertions_a_minute},
            {"by_stage_us", stages},
            {"events", events}}}};
}

void print(const char* clock, const bench::Spread& spread, int over) {
  std::printf(
      "  %-14s median %.0f us, mean %.0f, 99 %% below %.0f, 99.9 %% below %.0f, worst %.0f; %d steps over\n",
      clock, spread.median, spread.mean, spread.most_99, spread.most_999, spread.worst, over);
}

void print(const bench::InsertionCost& cost, const Scene& scene) {
  std::printf(
      "%d tetrahedra, %d nodes: %d steps of %g ms, %.2f s simulated, to %.1e, %.1f iterations a step\n",
      cost.tetrahedra, cost.nodes, cost.steps, cost.time_step / units::ms, cost.simulated,
      scene.run.solver_tolerance, cost.iterations);
  if (cost.threads > 1)
    std::printf("  shared by %d threads, all times on the wall\n", cost.threads);
  else
    print("processor time", cost.processor, cost.over);
  print("wall time", cost.wall, cost.over_wall);
  if (cost.spare >= 0.0)
    std::printf("  %.0f %% of a step's own time to spare at the median", 100.0 * cost.spare);
  else
    std::printf("  nothing to spare: the median step takes %.1f times its own time", 1.0 - cost.spare);
  std::printf("; %.2f times real time, %.1f insertions a minute a core (%.2f s of each to build it)\n",
              cost.real_time_factor, cost.insertions_a_minute, cost.build);
  for (const bench::StageCost& c : cost.stages)
    std::printf("  %-16s %6d steps, %5.1f iterations, median %6.0f us, worst %6.0f us\n",
                name_of(c.stage).c_str(), c.steps, c.iterations, c.median, c.worst);
  std::printf("  happened:");
  for (const Event& event : cost.events)
    std::printf("%s %s at %.3f s", &event == &cost.events.front() ? "" : ",", name_of(event.kind).c_str(),
                event.time);
  std::printf("%s\n", cost.events.empty() ? " nothing" : "");
  std::fflush(stdout);
}

std::optional<std::string> complaint(const BenchOptions& options) {
  if (options.steps_given) return "--steps is for single steps; an insertion goes to its end, leave it away";
  if (options.equal_given)
    return "--equal is for single steps; an insertion is solved to --set run.solver_tolerance=";
  for (const std::string& setting : options.settings)
    if (setting.starts_with("tissue.tetrahedra"))
      return "tissue.tetrahedra: the number of tetrahedra is given with --sizes; leave the setting away";
  return std::nullopt;
}

}  // namespace

int measure_insertions(const BenchOptions& options) {
  if (const auto wrong = complaint(options)) return refused(*wrong, bad_input);
  constexpr int usual_size = 10000;
  Json results = Json::array();
  for (int size : options.sizes_given ? options.sizes : std::vector{usual_size}) {
    const Result<Scene> scene = scene_for(options, size);
    if (!scene) return refused(scene.error().sentence, bad_input);
    Progress progress("step", io::step_count(*scene), options.json);
    const Result<bench::InsertionCost> cost = bench::measure_insertion(
        *scene, [&](long steps) { progress.update(steps); }, options.threads);
    if (!cost) return refused(cost.error().sentence, run_failed);
    if (options.json)
      results.push_back(as_json(*cost, *scene));
    else
      print(*cost, *scene);
  }
  if (options.json) std::cout << Json{{"results", results}}.dump(2) << "\n";
  return done;
}

}  // namespace acus::app
