#include "acus/haptics/recorder.h"

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <utility>

#include "acus/io/replay.h"

namespace acus::haptics {
namespace {

// A fifth of the second that may be lost; the rest is for a slow disk.
constexpr auto writing_interval = std::chrono::milliseconds(200);

// What stands at `path` may be replaced: nothing, an empty file, or a recording.
bool may_be_replaced(const std::string& path) {
  std::error_code unknown;
  if (!std::filesystem::is_regular_file(path, unknown)) return true;  // the file itself will say
  std::string beginning(io::recording_mark.size(), '\0');
  std::ifstream file(path, std::ios::binary);
  file.read(beginning.data(), static_cast<std::streamsize>(beginning.size()));
  return file.gcount() == 0 || beginning == io::recording_mark;
}

}  // namespace

Result<std::unique_ptr<Recorder>> Recorder::start(const std::string& path, const io::RecordedScene& scene,
                                                  const std::string& option, RecorderSizes sizes) {
  if (path.empty()) return Error{option + " is empty; name a file to record into"};
  if (!may_be_replaced(path))
    return Error{path + ": is there already and is no recording; choose another name with " + option};
  if (scene.scene.size() + scene.versions.size() > io::longest_payload / 2)
    return Error{path + ": this scene is too long to be recorded; shorten hand.path"};
  std::uint32_t checksum = io::recording_head_checksum();
  const std::string beginning = io::recording_head() + io::block_bytes(scene, checksum);
  Result<io::AppendFile> file = io::AppendFile::create(path, beginning, option);
  if (!file) return file.error();
  return std::unique_ptr<Recorder>(new Recorder(path, std::move(file).value(), checksum, sizes));
}

Result<std::unique_ptr<Recorder>> Recorder::start(const std::string& path, const Scene& scene,
                                                  const std::string& option) {
  const Result<io::RecordedScene> recorded = io::recorded_scene(scene);
  if (!recorded) return recorded.error();
  return start(path, *recorded, option);
}

Recorder::Recorder(std::string path, io::AppendFile file, std::uint32_t checksum, RecorderSizes sizes)
    : step_ring_(sizes.steps),
      tick_ring_(sizes.ticks),
      path_(std::move(path)),
      file_(std::move(file)),
      checksum_(checksum),
      writer_([this] { write_until_finished(); }) {}

Recorder::~Recorder() { stop_writing(); }

void Recorder::step(double travel, std::optional<std::uint64_t> hash) noexcept {
  ++steps_;
  if (failed_.load(std::memory_order_relaxed) || first_lost_.load(std::memory_order_relaxed) != 0) return;
  if (!step_ring_.push({travel, hash.value_or(0), hash.has_value()}))
    first_lost_.store(steps_, std::memory_order_release);
}

void Recorder::tick(const io::RecordedTick& tick) noexcept {
  if (failed_.load(std::memory_order_relaxed)) return;
  if (!tick_ring_.push(tick)) ticks_lost_.fetch_add(1, std::memory_order_relaxed);
}

void Recorder::wait_for_room() {
  while (step_ring_.size() == step_ring_.capacity() && !failed_) {
    {
      const std::lock_guard lock(mutex_);
      asked_for_room_ = true;
    }
    wake_.notify_one();
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
}

std::optional<Error> Recorder::failure() const {
  const std::lock_guard lock(mutex_);
  return failure_;
}

std::optional<Error> Recorder::finish(std::uint64_t final_hash) {
  stop_writing();
  append(io::block_bytes(io::RecordedEnd{{steps_, final_hash}}, checksum_));
  return failure();
}

void Recorder::stop_writing() {
  if (!writer_.joinable()) return;
  {
    const std::lock_guard lock(mutex_);
    finishing_ = true;
  }
  wake_.notify_one();
  writer_.join();
}

void Recorder::write_until_finished() {
  for (bool last = false; !last;) {
    {
      std::unique_lock lock(mutex_);
      wake_.wait_for(lock, writing_interval, [this] { return finishing_ || asked_for_room_; });
      asked_for_room_ = false;
      last = finishing_;
    }
    write_rings();
  }
}

void Recorder::write_rings() {
  // Asked before the ring is emptied: whatever the ring then holds stands before the first lost step.
  const std::uint64_t first_lost = first_lost_.load(std::memory_order_acquire);
  std::string bytes = steps_in_blocks();
  if (first_lost != 0 && !std::exchange(gap_written_, true)) {
    bytes += io::block_bytes(io::RecordedGap{first_lost}, checksum_);
    fail("the disk did not keep up; the recording has no steps from " + std::to_string(first_lost) + " on");
  }
  bytes += ticks_in_blocks();
  append(bytes);
}

// Not more than the ring holds: whoever fills it meanwhile is written next time.
std::string Recorder::steps_in_blocks() {
  std::string bytes;
  Step step;
  for (std::size_t left = step_ring_.size(); left > 0;) {
    io::RecordedSteps block;
    block.first = steps_written_ + 1;
    for (; left > 0 && block.travels.size() < io::most_steps_in_block && step_ring_.pop(step); --left) {
      ++steps_written_;
      block.travels.push_back(step.travel);
      if (step.hashed) block.hashes.push_back({steps_written_, step.hash});
    }
    bytes += io::block_bytes(block, checksum_);
  }
  return bytes;
}

std::string Recorder::ticks_in_blocks() {
  std::string bytes;
  io::RecordedTick tick;
  const std::uint64_t lost = ticks_lost_.load(std::memory_order_relaxed);
  for (std::size_t left = tick_ring_.size(); left > 0 || lost != ticks_lost_written_;) {
    io::RecordedTicks block;
    block.lost = lost - std::exchange(ticks_lost_written_, lost);
    for (; left > 0 && block.ticks.size() < io::most_ticks_in_block && tick_ring_.pop(tick); --left)
      block.ticks.push_back(tick);
    bytes += io::block_bytes(block, checksum_);
  }
  return bytes;
}

void Recorder::append(const std::string& bytes) {
  if (failed_ || bytes.empty()) return;
  if (const auto failed = file_.append(bytes)) {
    failed_ = true;
    fail(failed->sentence);
  }
}

void Recorder::fail(const std::string& sentence) {
  const std::lock_guard lock(mutex_);
  if (!failure_) failure_ = Error{sentence.starts_with(path_) ? sentence : path_ + ": " + sentence};
}

}  // namespace acus::haptics
