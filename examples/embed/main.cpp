// Pushes a bare needle against a fixed stop and prints the force that it settles at.
#include <acus/acus.h>

#include <cstdio>

int main() {
  acus::Scene scene;
  scene.tissue.rigid = true;
  auto simulation = acus::Simulation::build(scene);
  if (!simulation) return std::fprintf(stderr, "%s\n", simulation.error().sentence.c_str()), 1;
  const double end_shortening = 0.01 * scene.needle.length;  // m
  const int steps = 1000;
  for (int i = 1; i <= steps; ++i) simulation->step(end_shortening * i / steps);
  std::printf("%.4f\n", simulation->frame().hand_force);
}
