// Shorthands: one word of a scene for several of its numbers, as in needle.gauge = "22G". A scene holds the
// numbers alone, and is written with them.
#pragma once

#include <string>
#include <vector>

#include "acus/sim/scene.h"

namespace acus {

struct Shorthand {
  std::string name;                // dotted, as a key is: needle.gauge
  std::vector<std::string> words;  // that it can be
  std::vector<std::string> keys;   // that it sets
  void (*set)(Scene&, std::size_t word);
  std::string help;  // one line
};

const std::vector<Shorthand>& shorthands();

// The shorthand of that name, or null.
const Shorthand* find_shorthand(const std::string& name);

}  // namespace acus
