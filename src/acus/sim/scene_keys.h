// The keys of a scene: one table that reading, writing, checking and the key reference all follow.
//
// A key is the dotted name a user writes, with its unit at the end: needle.length_mm. The scene holds SI; a
// number as the user writes it is SI * 10^-power.
#pragma once

#include <string>
#include <variant>
#include <vector>

#include "acus/sim/scene.h"

namespace acus {

// What a number may be, in the unit of its key.
struct Range {
  double least = 0.0;
  double most = 0.0;
};

struct NumberField {
  double& (*of)(Scene&);
  int power;  // SI value = written value * 10^power
  Range range;
};
struct IntegerField {
  int& (*of)(Scene&);
  Range range;
};
struct SwitchField {
  bool& (*of)(Scene&);
};
struct ChoiceField {
  std::vector<std::string> names;  // in the order of the enumeration
  int (*get)(const Scene&);
  void (*set)(Scene&, int);
};
struct FileField {
  std::string& (*of)(Scene&);
};
struct VectorField {
  Vec3& (*of)(Scene&);
  int power;
  Range range;  // of each component
};
struct HandPathField {
  std::vector<HandPoint>& (*of)(Scene&);
  int travel_power;
  Range time;
  Range travel;
};

using SceneField =
    std::variant<NumberField, IntegerField, SwitchField, ChoiceField, FileField, VectorField, HandPathField>;

struct SceneKey {
  std::string name;  // dotted: table.key
  SceneField field;
  std::string help;  // one line
};

// In the order in which a scene is written: table by table.
const std::vector<SceneKey>& scene_keys();

// The key of that name, or null.
const SceneKey* find_scene_key(const std::string& name);

// "from 1 to 2000"
std::string in_words(const Range& range);

// Empty when `value`, in the unit of the key, is a finite number inside the range; else "must be ..., but is
// ...".
std::string complaint(const Range& range, double value);

}  // namespace acus
