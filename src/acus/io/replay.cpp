#include "acus/io/replay.h"

#include <filesystem>
#include <nlohmann/json.hpp>

#include "acus/base/hash.h"
#include "acus/io/insertion.h"
#include "acus/io/mesh_file.h"
#include "acus/io/scene_toml.h"
#include "acus/io/summary_json.h"

namespace acus::io {
namespace {

bool has_mesh_file(const Scene& scene) { return !scene.tissue.rigid && !scene.tissue.mesh.empty(); }

}  // namespace

Result<RecordedScene> recorded_scene(const Scene& scene) {
  Scene from_anywhere = scene;
  RecordedScene recorded;
  if (has_mesh_file(scene)) {
    const Result<std::uint64_t> hash = mesh_file_hash(scene.tissue.mesh);
    if (!hash) return hash.error();
    recorded.mesh_hash = *hash;
    std::error_code unknown;
    const auto path = std::filesystem::absolute(scene.tissue.mesh, unknown);
    if (!unknown) from_anywhere.tissue.mesh = path.string();
  }
  recorded.scene = scene_toml(from_anywhere);
  recorded.versions = json_text(versions_json());
  return recorded;
}

Result<Simulation> build_replay(const Recording& recording, const std::vector<std::string>& settings) {
  const Result<Scene> scene = with_settings(recording.scene, settings);
  if (!scene) return scene.error();
  const std::string& mesh = scene->tissue.mesh;
  if (has_mesh_file(*scene) && mesh == recording.scene.tissue.mesh) {
    const Result<std::uint64_t> hash = mesh_file_hash(mesh);
    if (!hash) return hash.error();
    if (*hash != recording.mesh_hash)
      return Error{mesh + ": this mesh was changed after the recording was made; put the old one back, or " +
                   "name another with --set tissue.mesh=FILE"};
  }
  return build_simulation(*scene);
}

bool HashCheck::operator()(const Simulation& simulation) {
  if (differs_) return false;
  if (std::exchange(begun_, true)) ++steps_;
  const auto& hashes = recording_.hashes;
  if (next_ < hashes.size() && hashes[next_].step == steps_) {
    if (simulation.state_hash() != hashes[next_].hash) {
      const std::uint64_t same = next_ > 0 ? hashes[next_ - 1].step : 0;
      differs_ = "step " + std::to_string(steps_) + " leaves another state, " + hex(simulation.state_hash()) +
                 " instead of " + hex(hashes[next_].hash) + "; " +
                 (same > 0 ? "step " + std::to_string(same) + " was the last one found the same"
                           : "no step before it was compared");
    }
    ++next_;
  }
  if (!differs_ && simulation.frame().health != Health::good && steps_ < recording_.travels.size())
    differs_ = "step " + std::to_string(steps_) + " fails, and in the recording it did not";
  return !differs_;
}

std::string version_difference(const Recording& recording) {
  const auto here = versions_json();
  const auto there = nlohmann::ordered_json::parse(recording.versions, nullptr, false);
  if (!there.is_object()) return "the recording does not say which program wrote it";
  std::string all;
  for (const auto& [name, version] : here.items()) {
    const std::string was = there.contains(name) ? there[name].dump() : "unknown";
    if (was == version.dump()) continue;
    all += (all.empty() ? "" : ", ") + name + " was " + was + " and is " + version.dump();
  }
  return all;
}

}  // namespace acus::io
