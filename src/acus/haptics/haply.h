// Haply's Inverse3 through the Haply Inverse Service, which speaks WebSocket on this machine.
#pragma once

#include <memory>
#include <string>

#include "acus/haptics/device.h"

namespace acus::haptics {

// Empty, or the sentence that says what is missing.
std::string haply_missing();

// `argument` is the port of the service; empty for 10001.
Result<std::unique_ptr<Device>> open_haply(const std::string& argument);

}  // namespace acus::haptics
