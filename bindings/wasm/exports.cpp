// What JavaScript sees of the engine: text in, text and bytes out. One session per module.
#include <cstddef>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>

#include "acus/base/hash.h"
#include "acus/io/insertion.h"
#include "acus/io/scene_toml.h"
#include "acus/sim/names.h"
#include "acus/view/studio_session.h"

namespace {

using acus::view::StudioSession;

StudioSession& session() {
  static StudioSession the_session({"wasm", std::nullopt, acus::view::build_without_files});
  return the_session;
}

// Text on its way out; JavaScript copies it before it calls again.
const char* handed_out(std::string text) {
  static std::string kept;
  kept = std::move(text);
  return kept.c_str();
}

std::span<const std::byte> frame;

nlohmann::json run(const char* toml) {
  const acus::Result<acus::Scene> scene = acus::io::parse_scene(toml, "scene");
  if (!scene) return {{"sentence", scene.error().sentence}};
  acus::Result<acus::Simulation> simulation = acus::view::build_without_files(*scene);
  if (!simulation) return {{"sentence", simulation.error().sentence}};
  const acus::io::Insertion insertion = acus::io::run_insertion(*simulation);
  return {{"state_hash", acus::hex(insertion.state_hash)},
          {"steps", insertion.summary.steps},
          {"outcome", acus::name_of(acus::outcome(insertion.events))}};
}

}  // namespace

extern "C" {

void acus_command(const char* json) { session().take(json); }

int acus_advance(double seconds, int most_steps) { return session().advance(seconds, most_steps); }

// Null when there is none.
const char* acus_next_report() {
  std::optional<std::string> report = session().next_report();
  return report ? handed_out(std::move(*report)) : nullptr;
}

// Writes the present moment and returns how many bytes it takes; they are at acus_frame().
std::size_t acus_write_frame() { return (frame = session().frame()).size(); }
const std::byte* acus_frame() { return frame.data(); }

// Of the running insertion; empty before the first.
const char* acus_state_hash() {
  const acus::Simulation* simulation = session().simulation();
  return handed_out(simulation != nullptr ? acus::hex(simulation->state_hash()) : "");
}

// A whole insertion by the scene's own hand: JSON with state_hash, steps and outcome, or a sentence.
const char* acus_run_scene(const char* toml) { return handed_out(run(toml).dump()); }

}  // extern "C"
