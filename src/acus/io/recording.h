// The bytes of a recording: a head, then blocks with a checksum each, as docs/recording.md lists them. Pure
// functions; files are recording_reader.h and append_file.h.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace acus::io {

inline constexpr std::uint32_t recording_format = 1;

struct RecordedScene {
  std::string scene;            // TOML, every key
  std::string versions;         // JSON, of the program that recorded
  std::uint64_t mesh_hash = 0;  // of the bytes of tissue.mesh; 0 without one
};

struct HashedStep {
  std::uint64_t step = 0;  // counted from 1
  std::uint64_t hash = 0;  // of the state after it
};

struct RecordedSteps {
  std::uint64_t first = 1;
  std::vector<double> travels;     // m, the input of each step
  std::vector<HashedStep> hashes;  // of some of these steps, rising
};

// What a device measured and was told in one of its ticks.
struct RecordedTick {
  double time = 0.0;                 // s, the device's clock
  std::array<double, 3> position{};  // m, the device's frame
  std::array<float, 3> velocity{};   // m/s
  std::array<float, 3> force{};      // N, as it left for the device
  std::uint32_t buttons = 0;
};

struct RecordedTicks {
  std::uint64_t lost = 0;  // before these, since the last block of ticks
  std::vector<RecordedTick> ticks;
};

// From `step` on the steps are missing: the writer did not keep up. No steps follow.
struct RecordedGap {
  std::uint64_t step = 0;
};

struct RecordedEnd {
  HashedStep last;  // the number of steps done, and the state after them
};

using RecordedBlock = std::variant<RecordedScene, RecordedSteps, RecordedTicks, RecordedGap, RecordedEnd>;

// No payload is longer, so that a damaged length cannot ask for much memory.
inline constexpr std::size_t longest_payload = 16U << 20U;
inline constexpr std::size_t most_steps_in_block = 1U << 16U;
inline constexpr std::size_t most_ticks_in_block = 1U << 16U;

inline constexpr std::string_view recording_mark{
    "\x89"
    "ACUS\r\n\x1a",
    8};
inline constexpr std::size_t recording_head_size = 16;
std::string recording_head();
// Of the head, from which the checksums of the blocks continue.
std::uint32_t recording_head_checksum();

// The block as it stands in a file behind bytes of checksum `so_far`, which becomes that of them all.
std::string block_bytes(const RecordedBlock& block, std::uint32_t& so_far);

// How a block begins.
inline constexpr std::size_t block_head_size = 8;
struct BlockHead {
  std::uint32_t kind = 0, payload_size = 0;
};
BlockHead block_head(std::string_view bytes);

std::uint32_t little_endian_32(std::string_view bytes);

// The block of a kind and its payload; nothing where the two do not make sense.
std::optional<RecordedBlock> block_of(std::uint32_t kind, std::string_view payload);

}  // namespace acus::io
