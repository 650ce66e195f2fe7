#include "acus/io/recording_reader.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "acus/base/crc32c.h"
#include "acus/io/scene_toml.h"

namespace acus::io {
namespace {

// The next bytes of a file: as many as wanted, or what is left of it.
std::string next_bytes(std::istream& file, std::size_t wanted) {
  std::string bytes(wanted, '\0');
  file.read(bytes.data(), static_cast<std::streamsize>(wanted));
  bytes.resize(static_cast<std::size_t>(file.gcount()));
  return bytes;
}

// Goes through the blocks one behind the other. After the first that cannot be believed there is nothing.
class BlockReader {
 public:
  explicit BlockReader(std::istream& file) : file_(file) {}

  std::optional<RecordedBlock> next() {
    const std::string head = next_bytes(file_, block_head_size);
    if (head.empty()) return std::nullopt;
    if (head.size() < block_head_size) return stopped("its next block is cut off");
    const auto [kind, payload_size] = block_head(head);
    if (payload_size > longest_payload) return stopped("its next block is damaged");
    constexpr std::size_t checksum_size = 4;
    const std::string body = next_bytes(file_, payload_size + checksum_size);
    if (body.size() < payload_size + checksum_size) return stopped("its next block is cut off or damaged");
    const std::string_view payload(body.data(), payload_size);
    const std::uint32_t checksum = crc32c(payload, crc32c(head, checksum_));
    if (checksum != little_endian_32(std::string_view(body).substr(payload_size)))
      return stopped("its next block is damaged");
    std::optional<RecordedBlock> block = block_of(kind, payload);
    if (!block) return stopped("its next block makes no sense, though its checksum is right");
    checksum_ = checksum;
    begin_ = at_;
    at_ += head.size() + body.size();
    return block;
  }

  std::uint64_t at() const { return at_; }        // byte of the next block
  std::uint64_t begin() const { return begin_; }  // byte of the last one
  // Why there is no next block; empty at the end of the file.
  const std::string& damage() const { return damage_; }

 private:
  std::nullopt_t stopped(const char* why) {
    damage_ = why;
    return std::nullopt;
  }

  std::istream& file_;
  std::uint32_t checksum_ = recording_head_checksum();
  std::uint64_t at_ = recording_head_size, begin_ = 0;
  std::string damage_;
};

std::string at_byte(const std::string& name, std::uint64_t byte) {
  return name + ": byte " + std::to_string(byte) + ": ";
}

std::string seconds(double time) {
  char text[40];
  std::snprintf(text, sizeof text, "%.3f s", time);
  return text;
}

// What is wrong with the head, if anything.
std::optional<Error> refusal_of_head(std::string_view head, const std::string& name) {
  if (head.empty()) return Error{name + ": the file is empty; expected a recording"};
  if (!recording_mark.starts_with(head.substr(0, recording_mark.size())))
    return Error{at_byte(name, 0) + "this is no recording; name a file that `acus run --record` wrote"};
  if (head.size() < recording_head_size)
    return Error{at_byte(name, head.size()) + "the recording ends before its scene; nothing of it is left"};
  const std::size_t sealed = recording_head_size - 4;
  if (crc32c(head.substr(0, sealed)) != little_endian_32(head.substr(sealed)))
    return Error{at_byte(name, 0) + "the head of the recording is damaged; nothing of it can be used"};
  const std::uint32_t format = little_endian_32(head.substr(recording_mark.size()));
  if (format != recording_format)
    return Error{at_byte(name, recording_mark.size()) + "is a recording of format " + std::to_string(format) +
                 ", and this program reads format " + std::to_string(recording_format) +
                 "; use the version of acus that wrote it"};
  return std::nullopt;
}

// Puts the blocks behind the scene together; what() is why one cannot follow those before it.
class Assembly {
 public:
  Assembly(Recording& recording, Ticks ticks) : recording_(recording), ticks_(ticks) {}

  const std::string& what() const { return what_; }
  bool ended() const { return recording_.whole || !what_.empty(); }

  void operator()(const RecordedScene&) { what_ = "a second scene follows"; }
  void operator()(const RecordedSteps& block) {
    if (gap_ || block.first != recording_.travels.size() + 1) {
      what_ = "the steps that follow are not the next ones";
      return;
    }
    recording_.travels.insert(recording_.travels.end(), block.travels.begin(), block.travels.end());
    recording_.hashes.insert(recording_.hashes.end(), block.hashes.begin(), block.hashes.end());
  }
  void operator()(const RecordedTicks& block) {
    recording_.ticks_lost += block.lost;
    if (ticks_ == Ticks::skip) return;
    recording_.ticks.insert(recording_.ticks.end(), block.ticks.begin(), block.ticks.end());
  }
  void operator()(const RecordedGap&) { gap_ = true; }
  void operator()(const RecordedEnd& block) {
    if (gap_) return;
    if (block.last.step != recording_.travels.size()) {
      what_ = "its end counts other steps";
      return;
    }
    auto& hashes = recording_.hashes;
    if (block.last.step > 0 && (hashes.empty() || hashes.back().step != block.last.step))
      hashes.push_back(block.last);
    recording_.whole = true;
  }

  std::string why_not_whole() const {
    if (!what_.empty()) return what_;
    return gap_ ? "the disk was too slow for the steps that follow, and they were lost"
                : "the program that wrote it was stopped there";
  }

 private:
  Recording& recording_;
  Ticks ticks_;
  bool gap_ = false;
  std::string what_;
};

}  // namespace

Result<Recording> read_recording(std::istream& file, const std::string& name, Ticks ticks) {
  if (auto refusal = refusal_of_head(next_bytes(file, recording_head_size), name)) return *refusal;
  BlockReader blocks(file);
  const std::optional<RecordedBlock> first = blocks.next();
  const auto* begin = first ? std::get_if<RecordedScene>(&*first) : nullptr;
  if (begin == nullptr)
    return Error{at_byte(name, recording_head_size) +
                 "the scene of the recording is missing or damaged; without it nothing can be replayed"};
  const Result<Scene> scene = parse_scene(begin->scene, name);
  if (!scene) return Error{at_byte(name, recording_head_size) + "in its scene: " + scene.error().sentence};

  Recording recording;
  recording.scene = *scene;
  recording.versions = begin->versions;
  recording.mesh_hash = begin->mesh_hash;
  Assembly assembly(recording, ticks);
  std::uint64_t believed = blocks.at();
  while (!assembly.ended()) {
    const std::optional<RecordedBlock> block = blocks.next();
    if (!block) break;
    std::visit(assembly, *block);
    believed = assembly.what().empty() ? blocks.at() : blocks.begin();
  }
  if (file.bad()) return Error{name + ": cannot be read to its end: " + std::strerror(errno)};
  if (!recording.whole)
    recording.loss = at_byte(name, believed) + "the recording ends at " +
                     seconds(static_cast<double>(recording.travels.size()) * recording.scene.run.time_step) +
                     ": " + (blocks.damage().empty() ? assembly.why_not_whole() : blocks.damage());
  else if (file.peek() != std::istream::traits_type::eof())
    recording.loss = at_byte(name, believed) + "what stands behind the end of the recording was not read";
  return recording;
}

Result<Recording> read_recording(const std::string& path, Ticks ticks) {
  std::error_code unknown;
  const auto kind = std::filesystem::status(path, unknown).type();
  if (kind == std::filesystem::file_type::not_found) return Error{path + ": there is no such file"};
  if (kind != std::filesystem::file_type::regular)
    return Error{path + ": is not a regular file; name a recording"};
  std::ifstream file(path, std::ios::binary);
  if (!file) return Error{path + ": cannot be read: " + std::strerror(errno)};
  return read_recording(file, path, ticks);
}

}  // namespace acus::io
