// Recordings from files: everything up to the first block that is damaged, and one sentence about what is
// missing.
#pragma once

#include <iosfwd>
#include <string>
#include <vector>

#include "acus/base/result.h"
#include "acus/io/recording.h"
#include "acus/sim/scene.h"

namespace acus::io {

struct Recording {
  Scene scene;
  std::string versions;         // JSON, of the program that recorded
  std::uint64_t mesh_hash = 0;  // of the bytes of tissue.mesh; 0 without one

  std::vector<double> travels;     // m, the input of each step
  std::vector<HashedStep> hashes;  // of the states after some of them, rising; the last step's when whole
  std::vector<RecordedTick> ticks;
  std::uint64_t ticks_lost = 0;  // while recording, because the disk was slow

  bool whole = false;  // it has its end, and nothing is missing before it
  std::string loss;    // what is missing and why, with file and byte; empty when whole
};

enum class Ticks { read, skip };

// Error: not a recording, one of a newer format, or damaged before the end of its scene.
Result<Recording> read_recording(const std::string& path, Ticks ticks = Ticks::skip);

// The same from a stream; `name` is what sentences call it.
Result<Recording> read_recording(std::istream& file, const std::string& name, Ticks ticks = Ticks::skip);

}  // namespace acus::io
