// The map of docs/haptics.md: how stiff a spring each device shows in each hand before it swings, over the
// delay of its force, and the stiffness that the coupling takes there. Writes one picture for each hand into
// a folder.
#include <cstdio>
#include <fstream>
#include <string>

#include "acus/haptics/virtual_coupling.h"
#include "acus/study/plot.h"
#include "sampled_spring.h"

namespace acus::haptics {
namespace {

constexpr double tick = 1e-3;         // s
constexpr double stiffest = 20000.0;  // N/m, looked for

double stiffest_stable(const HandModel& hand, const DeviceLimits& device) {
  const double damping = coupling_for(device).damping;
  double stable = 0.0, unstable = stiffest;
  while (unstable - stable > 0.01 * unstable) {
    const double K = 0.5 * (stable + unstable);
    constexpr double watched = 8.0;  // s
    (growth(K, damping, hand, device, tick, watched) > 1.0 ? unstable : stable) = K;
  }
  return stable;
}

study::Svg map_of(const char* name, const HandModel& hand) {
  study::Plot plot;
  plot.title = std::string("Stiffest stable spring, ") + name;
  plot.description =
      "For each device the stiffness at which a sampled spring loses stability, falling with the delay of "
      "the device's force; dashed, the stiffness of the coupling, at most half of it without a hand.";
  plot.x_label = "delay of the force, ms";
  plot.y_label = "stiffness, N/m";
  int style = 0;
  for (const DeviceLimits& row : known_devices()) {
    study::Curve stable{row.name, style, {}, study::Curve::Dash::solid};
    study::Curve taken{"", style, {}, study::Curve::Dash::dashed};
    for (double delay : {0.0, 0.25e-3, 0.5e-3, 1e-3, 1.5e-3, 2e-3, 3e-3, 4e-3, 5e-3}) {
      DeviceLimits device = row;
      device.delay = delay;
      stable.points.push_back({1e3 * delay, stiffest_stable(hand, device)});
      taken.points.push_back({1e3 * delay, coupling_for(device).stiffness});
    }
    plot.curves.push_back(stable);
    plot.curves.push_back(taken);
    ++style;
  }
  return study::drawn(plot);
}

}  // namespace
}  // namespace acus::haptics

int main(int count, char** arguments) {
  using namespace acus::haptics;
  if (count != 2) return std::fprintf(stderr, "usage: stability_map FOLDER\n"), 2;
  const struct {
    const char *name, *file;
    HandModel hand;
  } hands[] = {{"no hand", "no_hand", no_hand},
               {"a light grip", "light_grip", light_grip},
               {"a whole arm", "whole_arm", whole_arm}};
  for (const auto& h : hands)
    std::ofstream(std::string(arguments[1]) + "/stability_" + h.file + ".svg")
        << map_of(h.name, h.hand).document();
}
