// One page with a simulation of its own: takes commands, is advanced by the time on the wall, and hands out
// reports and frames. It has no threads, no clock and no files; the engine in a browser is this and little
// more.
#pragma once

#include <deque>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "acus/sim/simulation.h"
#include "acus/view/command.h"
#include "acus/view/frame_bytes.h"
#include "acus/view/led_hand.h"

namespace acus::view {

// Where an engine runs.
struct Source {
  std::string name;                   // "wasm" or "serve"
  std::optional<std::string> device;  // its title
  Result<Simulation> (*build)(const Scene&, int threads) = nullptr;
  int threads = 1;  // that share a step
};

// The simulation of a scene that names no file; else a sentence that says why not.
Result<Simulation> build_without_files(const Scene& scene, int threads = 1);

class StudioSession {
 public:
  // The first report says hello.
  explicit StudioSession(Source source);

  // Takes a command as JSON text; what is wrong with it is answered by `refused`.
  void take(std::string_view command);

  // Lets `seconds` pass on the wall: steps the simulation in its own time step, but at most `most_steps`
  // times, so that a machine that is too slow goes into slow motion. Returns the steps that were taken.
  int advance(double seconds, int most_steps = 100);

  // The oldest report that was not handed out yet.
  std::optional<std::string> next_report();

  // The present moment as bytes; none before the first `start`. Valid until the next call of any member.
  std::span<const std::byte> frame();

  // Null before the first `start`.
  const Simulation* simulation() const { return simulation_ ? &*simulation_ : nullptr; }
  // Its time stands still, but for single steps.
  bool paused() const { return paused_; }

 private:
  struct Taker;

  void report(std::string text) { reports_.push_back(std::move(text)); }
  void refuse(const std::string& sentence);
  Result<Scene> scene_of(const SceneChoice& choice) const;
  void start(const SceneChoice& choice);
  void check(const SceneChoice& choice);
  bool can_move();
  int steps_due(double seconds, int most_steps);
  void step();

  Source source_;
  std::optional<Simulation> simulation_;
  LedHand hand_;
  FrameScratch scratch_;
  std::vector<std::byte> frame_;
  std::deque<std::string> reports_;
  std::size_t events_told_ = 0;
  bool paused_ = false;
  bool ended_ = false;       // the simulation failed
  double rate_ = 1.0;        // simulated seconds in one of the wall
  double owed_ = 0.0;        // s, simulated, that passed and was not stepped yet
  int steps_asked_for_ = 0;  // while paused
};

}  // namespace acus::view
