// What an engine tells a page, as JSON text: docs/studio-protocol.md.
#pragma once

#include <optional>
#include <string>

#include "acus/sim/prediction.h"
#include "acus/sim/simulation.h"

namespace acus::view {

// `source`: "wasm" or "serve"; `device`: its title.
std::string hello_report(const std::string& source, const std::optional<std::string>& device);
std::string model_report(const Simulation& simulation);
std::string expectation_report(const Scene& scene);
std::string event_report(const Event& event);
std::string refused_report(const std::string& sentence);
std::string failed_report(const std::string& sentence);
// What `refused` says to a scene that is too large.
inline constexpr const char* out_of_memory =
    "there is not enough memory for this; ask for fewer tissue.tetrahedra";

}  // namespace acus::view
