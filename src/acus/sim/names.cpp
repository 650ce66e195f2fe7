#include "acus/sim/names.h"

#include <array>

namespace acus {
namespace {

// The names stand in the order of the enumeration.
template <std::size_t count, class Enum>
std::string chosen(const std::array<const char*, count>& names, Enum value) {
  return names.at(static_cast<std::size_t>(value));
}

}  // namespace

std::string name_of(Stage stage) {
  return chosen(std::array{"free", "contact", "buckled", "inserted", "inserted_buckled", "withdrawn"}, stage);
}

std::string name_of(EventKind kind) {
  return chosen(
      std::array{"contact", "buckling", "straightening", "puncture", "second_buckling", "layer", "exit"},
      kind);
}

std::string name_of(Outcome outcome) {
  return chosen(std::array{"straight_puncture", "buckled_then_punctured", "never_punctured"}, outcome);
}

std::string name_of(Health health) {
  return chosen(std::array{"good", "solver_broke_down", "not_finite", "needle_folded", "hub_at_entry"},
                health);
}

std::string name_of(needle::Support support) {
  return chosen(std::array{"pinned_pinned", "clamped_pinned", "clamped_clamped", "clamped_free"}, support);
}

std::string name_of(StepPart part) {
  return chosen(std::array<const char*, step_parts>{"contact", "assembly", "rod", "coupling", "solve",
                                                    "rotation", "cutting", "ledger"},
                part);
}

}  // namespace acus
