// What a page may ask of an engine: docs/studio-protocol.md, from JSON text.
#pragma once

#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "acus/base/result.h"

namespace acus::view {

struct SceneChoice {
  std::string toml;
  std::vector<std::string> settings;  // laid over it, "needle.length_mm=150"
};

struct Start {
  SceneChoice scene;
};
struct Check {
  SceneChoice scene;
};
struct Push {
  double travel;  // m
};
struct Steady {
  double speed;  // m/s
};
struct Pause {};
struct Resume {};
struct Step {
  int steps;
};
struct Rate {
  double factor;  // simulated seconds in one of the wall
};
struct Arm {};
struct Disarm {};

using Command = std::variant<Start, Check, Push, Steady, Pause, Resume, Step, Rate, Arm, Disarm>;

inline constexpr std::size_t longest_command = 2U << 20U;  // bytes
inline constexpr int deepest_command = 8;                  // brackets in brackets

// Whatever the text is, a command or one sentence that says what is wrong with it.
Result<Command> parse_command(std::string_view text);

}  // namespace acus::view
