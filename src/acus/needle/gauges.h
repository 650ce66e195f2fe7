// Gauges: the tubes that needles are drawn as, and what they are made of. The one table of both; the page's
// is written from it.
#pragma once

#include <span>

namespace acus::needle {

struct Gauge {
  const char* name;       // "22G"
  double outer_diameter;  // m, nominal
  double inner_diameter;  // m, nominal, regular wall
};

struct Material {
  const char* name;       // as a scene writes it
  const char* words;      // as a person says it
  double youngs_modulus;  // Pa
  double density;         // kg/m^3
  const char* source;
};

// Hypodermic tube from 14 to 30 G, thickest first, after the needle gauge comparison chart (which is after
// the Birmingham wire gauge; ISO 9626 rounds the diameters to metric sizes).
std::span<const Gauge> gauges();

std::span<const Material> materials();

}  // namespace acus::needle
