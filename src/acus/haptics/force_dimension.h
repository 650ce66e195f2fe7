// Force Dimension's devices (omega and its sisters) through the maker's DHD library.
#pragma once

#include <memory>
#include <string>

#include "acus/haptics/device.h"

namespace acus::haptics {

// Empty, or the sentence that says what is missing.
std::string force_dimension_missing();

// `argument` is the number of the device among those plugged in, from 0; empty for the first.
Result<std::unique_ptr<Device>> open_force_dimension(const std::string& argument);

}  // namespace acus::haptics
