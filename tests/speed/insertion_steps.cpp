// insertion_steps rod|column: a needle inserted a few millimetres, step by step, through all that a step may
// do: touch, puncture, cut, rub. instructions.sh counts what the steps take.
#include <cstdio>
#include <string_view>

#include "acus/sim/simulation.h"

int main(int argc, char** argv) {
  using namespace acus;
  Scene scene;
  scene.needle_model =
      argc > 1 && argv[1] == std::string_view("column") ? NeedleModel::column : NeedleModel::rod;
  scene.tissue.tetrahedra = 3000;
  scene.contact.rupture_force = 0.1;        // N
  scene.contact.fracture_toughness = 20.0;  // J/m^2
  auto simulation = Simulation::build(scene);
  if (!simulation) {
    std::fprintf(stderr, "%s\n", simulation.error().sentence.c_str());
    return 1;
  }
  constexpr int steps = 100;
  constexpr double stride = 0.08e-3, enough = 5e-3;  // m
  for (int step = 1; step <= steps; ++step) simulation->step(step * stride);
  const Frame& last = simulation->frame();
  if (last.health == Health::good && last.inserted_length > enough) return 0;
  std::fprintf(stderr, "the needle should be 5 mm inside; it is %g mm inside\n", 1e3 * last.inserted_length);
  return 1;
}
