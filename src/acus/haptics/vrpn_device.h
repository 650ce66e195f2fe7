// Devices behind a VRPN server, near or far: its trackers say where the handle is, its force fields push it.
#pragma once

#include <memory>
#include <string>

#include "acus/haptics/device.h"

namespace acus::haptics {

// Empty where acus was built with VRPN; else the sentence that says how to get it.
std::string vrpn_missing();

// `argument` is "NAME@HOST" or "NAME@HOST:PORT", with the name of the device in the server's configuration.
Result<std::unique_ptr<Device>> open_vrpn(const std::string& argument);

}  // namespace acus::haptics
