// A device in somebody's hand. The device owns the rhythm: each driver has its own way to keep time (a
// callback, a reply to a message, a sleep), so the device calls us, once a tick, and puts out the force that
// we return.
#pragma once

#include <array>
#include <atomic>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "acus/base/result.h"
#include "acus/base/vec.h"
#include "acus/haptics/device_limits.h"

namespace acus::haptics {

// Where the handle is, in the device's own frame.
struct DeviceState {
  double time = 0.0;                    // s, monotonic; the origin is the device's
  Vec3 position = Vec3::Zero();         // m
  Vec3 velocity = Vec3::Zero();         // m/s
  Mat3 orientation = Mat3::Identity();  // of the handle; the identity where the device does not measure it
  unsigned buttons = 0;                 // bit i: button i is down
  bool ready = false;                   // calibrated and held; where it is false no force is put out
};

struct Wrench {
  Vec3 force = Vec3::Zero();   // N, in the device's frame
  Vec3 torque = Vec3::Zero();  // N m
};

// What is done in one tick. Allocates nothing, takes no lock, writes nothing, throws nothing.
class Tick {
 public:
  virtual Wrench operator()(const DeviceState& state) noexcept = 0;

 protected:
  ~Tick() = default;
};

class Device {
 public:
  virtual ~Device() = default;

  virtual const DeviceLimits& limits() const = 0;

  // Calls `tick` at the device's rate, at 1 kHz where it has a choice, ready or not, until `stop` is true;
  // puts out nothing but what tick returns, and zero before it returns. An error says in one sentence how the
  // device was lost.
  virtual std::optional<Error> serve(Tick& tick, const std::atomic<bool>& stop) = 0;
};

}  // namespace acus::haptics
