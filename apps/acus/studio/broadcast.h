// What an engine has said and shown, for any number of clients who come and go. Within an insertion the
// engine never waits for one of them: what it says while a client is looking is handed over a moment later,
// and whoever is slow misses frames.
#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "acus/sim/simulation.h"
#include "acus/view/frame_bytes.h"

namespace acus::app {

class Broadcast {
 public:
  // As JSON text; one for all clients, lest each wait while another copies it.
  using Report = std::shared_ptr<const std::string>;

  // --- by the engine's thread ---

  // A new insertion: its `model` report, and everything about earlier ones is forgotten.
  void begin(std::string model, const Simulation& simulation);
  // A report that whoever comes later is told too.
  void keep(std::string report);
  // The newest report on how the loop is doing.
  void status(std::string report);
  // The present moment, unless the last one was shown less than a sixtieth of a second ago. To be called
  // often: it also hands over what had to wait.
  void show(const Simulation& simulation, double now);

  // --- by any thread ---

  // A report for those who are there now.
  void pass(std::string report);

  // --- by a client's thread ---

  struct Place {
    std::uint64_t insertion = 0, report = 0, passing = 0, status = 0, frame = 0;
  };
  // Of a client that is new.
  Place beginning() const;
  // The reports since `place`, oldest first; all of the present insertion for a client that is new.
  std::vector<Report> reports_since(Place& place) const;
  // The newest status, where there is one since `place`.
  std::optional<std::string> status_since(Place& place) const;
  // Whether there is a frame since `place`, and then its bytes.
  bool frame_since(Place& place, std::string& bytes) const;

 private:
  void hand_over();

  // Of the engine's thread.
  view::FrameScratch scratch_;
  std::vector<std::byte> next_frame_;
  bool frame_waits_ = false;
  double shown_ = -1.0;  // s
  std::vector<Report> waiting_;
  std::string next_status_;  // empty: none waits

  mutable std::mutex mutex_;  // of the following
  std::uint64_t insertion_ = 0;
  std::vector<Report> reports_;  // of this insertion
  std::deque<Report> passing_;   // the last few
  std::uint64_t passed_ = 0;     // how many there were
  std::string status_;
  std::uint64_t status_number_ = 0;
  std::vector<std::byte> frame_;
  std::uint64_t frame_number_ = 0;
};

}  // namespace acus::app
