// A device that lets a test see each tick: what it said, and what it was told to show.
#pragma once

#include <functional>
#include <utility>

#include "acus/haptics/device.h"

namespace acus::haptics {

class WatchedDevice final : public Device {
 public:
  using See = std::function<void(const DeviceState&, const Wrench&)>;
  WatchedDevice(Device& device, See see) : device_(device), see_(std::move(see)) {}

  const DeviceLimits& limits() const override { return device_.limits(); }
  std::optional<Error> serve(Tick& tick, const std::atomic<bool>& stop) override {
    Seeing seeing(tick, see_);
    return device_.serve(seeing, stop);
  }

 private:
  class Seeing final : public Tick {
   public:
    Seeing(Tick& tick, const See& see) : tick_(tick), see_(see) {}
    Wrench operator()(const DeviceState& state) noexcept override {
      const Wrench wrench = tick_(state);
      see_(state, wrench);
      return wrench;
    }

   private:
    Tick& tick_;
    const See& see_;
  };

  Device& device_;
  See see_;
};

}  // namespace acus::haptics
