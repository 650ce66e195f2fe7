// From a scene to the beginning of its recording, and from a recording back to the same bits.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "acus/base/result.h"
#include "acus/io/recording_reader.h"
#include "acus/sim/simulation.h"

namespace acus::io {

// What a recording of this scene begins with. The mesh file is named from the root of the file system, so
// that the recording may be moved. Error: the mesh file cannot be read.
Result<RecordedScene> recorded_scene(const Scene& scene);

// The simulation of the recorded scene with `settings` laid over it. Error: a setting is wrong, or
// tissue.mesh is no longer the file that it was.
Result<Simulation> build_replay(const Recording& recording, const std::vector<std::string>& settings = {});

// Holds the states of a replay against the recorded hashes.
class HashCheck {
 public:
  explicit HashCheck(const Recording& recording) : recording_(recording) {}

  // Takes the state before the first step and after every step; false once one is not the recorded one.
  bool operator()(const Simulation& simulation);

  int compared() const { return static_cast<int>(next_) - (differs_ ? 1 : 0); }
  // Where the replay left the recording; nothing while it is the same.
  std::optional<std::string> difference() const { return differs_; }

 private:
  const Recording& recording_;
  std::uint64_t steps_ = 0;
  std::size_t next_ = 0;  // of the recorded hashes
  bool begun_ = false;
  std::optional<std::string> differs_;
};

// What this program and the one that recorded differ in; empty when they are of the same versions.
std::string version_difference(const Recording& recording);

}  // namespace acus::io
