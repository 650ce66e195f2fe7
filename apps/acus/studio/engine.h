// What is behind a studio server: an insertion that pages lead by hand, or one that a device leads.
#pragma once

#include <atomic>
#include <memory>
#include <optional>
#include <string>

#include "acus/haptics/backends.h"
#include "acus/haptics/haptic_loop.h"
#include "acus/sim/scene.h"
#include "broadcast.h"

namespace acus::app {

class Engine {
 public:
  virtual ~Engine() = default;
  // The device's title, where there is one.
  virtual std::optional<std::string> device() const { return std::nullopt; }
  // Once, before anybody is told of it and when the port is ours. Error: it cannot do as it was asked.
  virtual std::optional<Error> begin() { return std::nullopt; }
  // A command of whoever leads; from a client's thread.
  virtual void take(const std::string& command) = 0;
  // Nobody leads any more; from any thread.
  virtual void let_go() = 0;
  // Until `stop` is true. How it went, where it did not go well.
  virtual std::optional<Error> run(Broadcast& broadcast, const std::atomic<bool>& stop) = 0;
};

// Pages lead the hand.
std::unique_ptr<Engine> led_engine(const Scene& scene, int threads = 1);

struct DeviceSettings {
  double force_limit = 0.0;           // N; 0: the device's own
  std::optional<std::string> record;  // file for the first insertion; those after it are recorded beside it
  int threads = 1;                    // that share a step
};
// `device` leads; pages watch, arm and disarm, and choose scenes.
std::unique_ptr<Engine> device_engine(haptics::OpenDevice device, Simulation first,
                                      const DeviceSettings& settings);

}  // namespace acus::app
