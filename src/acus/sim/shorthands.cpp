#include "acus/sim/shorthands.h"

#include <algorithm>

#include "acus/needle/gauges.h"

namespace acus {
namespace {

template <typename Rows>
std::vector<std::string> names_of(const Rows& rows) {
  std::vector<std::string> names;
  for (const auto& row : rows) names.emplace_back(row.name);
  return names;
}

void set_gauge(Scene& scene, std::size_t word) {
  const needle::Gauge& gauge = needle::gauges()[word];
  scene.needle.radius = 0.5 * gauge.outer_diameter;
  scene.needle.inner_radius = 0.5 * gauge.inner_diameter;
}

void set_material(Scene& scene, std::size_t word) {
  const needle::Material& material = needle::materials()[word];
  scene.needle.youngs_modulus = material.youngs_modulus;
  scene.needle.density = material.density;
}

}  // namespace

const std::vector<Shorthand>& shorthands() {
  static const std::vector<Shorthand> all = {
      {"needle.gauge",
       names_of(needle::gauges()),
       {"needle.radius_mm", "needle.inner_radius_mm"},
       set_gauge,
       "a hypodermic tube, of a gauge below"},
      {"needle.material",
       names_of(needle::materials()),
       {"needle.youngs_modulus_GPa", "needle.density_kg_m3"},
       set_material,
       "what the needle is made of, of the materials below"},
  };
  return all;
}

const Shorthand* find_shorthand(const std::string& name) {
  const auto& all = shorthands();
  const auto found = std::find_if(all.begin(), all.end(), [&](const Shorthand& s) { return s.name == name; });
  return found == all.end() ? nullptr : &*found;
}

}  // namespace acus
