// The ways to reach a device, by the name that a user types.
#pragma once

#include <memory>
#include <span>
#include <string>

#include "acus/haptics/device.h"

namespace acus::haptics {

struct Backend {
  const char* name;   // "haply"
  const char* title;  // for people
  const char* proof;  // what it was tested with
  // Empty when a device can be opened now; else what is missing and how to get it, in one sentence.
  std::string (*missing)();
  // `argument` is what stands behind the colon in "haply:10001"; empty without one.
  Result<std::unique_ptr<Device>> (*open)(const std::string& argument);
};

// For Backend::proof, until somebody runs the real thing.
inline constexpr const char* emulator_only = "tested against an emulator only";

std::span<const Backend> backends();

struct OpenDevice {
  const Backend* by;
  std::unique_ptr<Device> device;
};

// "name" or "name:argument".
Result<OpenDevice> open_device(const std::string& name);

}  // namespace acus::haptics
