// A scene that is quick to build and to step.
#pragma once

#include <string>

namespace acus::view {

inline const std::string small_scene =
    "[tissue]\ntetrahedra = 300\n[contact]\nrupture_force_N = 0.65\n[hand]\nspeed_mm_s = 20\ntravel_mm = "
    "40\n";

}  // namespace acus::view
