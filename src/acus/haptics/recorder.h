// Writes a session down while it runs. The threads that keep time put their steps and ticks into rings, which
// is all they ever wait for; a thread of the recorder's own empties the rings five times a second and waits
// until the disk has the block. A kill or a power cut loses what the rings held and the block on its way.
//
// When the disk is slower than the rings are long, or full, the recording ends there and failure() says so;
// the threads that keep time do not notice.
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "acus/base/result.h"
#include "acus/haptics/ring.h"
#include "acus/io/append_file.h"
#include "acus/io/recording.h"
#include "acus/sim/scene.h"

namespace acus::haptics {

// How many the rings hold. By default a disk may rest for 16 s at 1 kHz.
struct RecorderSizes {
  std::size_t steps = 1U << 14U, ticks = 1U << 14U;
};

class Recorder {
 public:
  // The hash of 10 000 tetrahedra takes 0.18 ms (docs/recording.md), so only every so many steps have one.
  static constexpr std::uint64_t hash_stride = 250;

  // Begins the file, with the scene in it when this returns; a recording that stood there is replaced, any
  // other file is refused. `option` is what a user types to choose another name.
  static Result<std::unique_ptr<Recorder>> start(const std::string& path, const io::RecordedScene& scene,
                                                 const std::string& option, RecorderSizes sizes = {});
  static Result<std::unique_ptr<Recorder>> start(const std::string& path, const Scene& scene,
                                                 const std::string& option);
  // Without finish() the recording has no end: a session that was broken off.
  ~Recorder();

  // The input of a step that was taken, and the hash of the state after it where hash_due() asked for it
  // before. Wait-free; for the one thread that steps.
  void step(double travel, std::optional<std::uint64_t> hash = std::nullopt) noexcept;
  bool hash_due() const noexcept { return steps_ % hash_stride == 0; }
  // Wait-free; for the one thread that serves the device.
  void tick(const io::RecordedTick& tick) noexcept;

  // Waits until a step has room: for whoever steps as fast as it can instead of in real time.
  void wait_for_room();

  // What went wrong so far, in one sentence. Takes a lock: not for the threads that keep time.
  std::optional<Error> failure() const;

  // Writes the rest and the end; nothing may be recorded any more. What went wrong, if anything.
  std::optional<Error> finish(std::uint64_t final_hash);

  Recorder(const Recorder&) = delete;
  Recorder& operator=(const Recorder&) = delete;

 private:
  struct Step {
    double travel = 0.0;
    std::uint64_t hash = 0;
    bool hashed = false;
  };

  Recorder(std::string path, io::AppendFile file, std::uint32_t checksum, RecorderSizes sizes);
  void write_until_finished();
  void write_rings();
  void stop_writing();
  std::string steps_in_blocks();
  std::string ticks_in_blocks();
  void append(const std::string& bytes);
  void fail(const std::string& sentence);

  // Of the threads that keep time.
  Ring<Step> step_ring_;
  Ring<io::RecordedTick> tick_ring_;
  std::uint64_t steps_ = 0;                   // given so far
  std::atomic<std::uint64_t> first_lost_{0};  // step that found no room; 0: none
  std::atomic<std::uint64_t> ticks_lost_{0};  // ever
  std::atomic<bool> failed_{false};           // writing has stopped

  // Of the thread that writes.
  std::string path_;
  io::AppendFile file_;
  std::uint32_t checksum_;
  std::uint64_t steps_written_ = 0, ticks_lost_written_ = 0;
  bool gap_written_ = false;

  mutable std::mutex mutex_;  // of the following
  std::condition_variable wake_;
  bool finishing_ = false, asked_for_room_ = false;
  std::optional<Error> failure_;

  std::thread writer_;
};

}  // namespace acus::haptics
