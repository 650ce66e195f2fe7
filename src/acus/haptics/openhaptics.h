// 3D Systems' devices (Touch, Phantom Omni, Phantom Premium) through OpenHaptics.
#pragma once

#include <memory>
#include <string>

#include "acus/haptics/device.h"

namespace acus::haptics {

// Empty, or the sentence that says what is missing.
std::string openhaptics_missing();

// `argument` is the device's name in the driver's configuration; empty for its default device.
Result<std::unique_ptr<Device>> open_openhaptics(const std::string& argument);

}  // namespace acus::haptics
