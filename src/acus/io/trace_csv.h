// Traces and events as comma-separated text: a header row, SI units, and numbers that read back to the bit.
#pragma once

#include <string>

#include "acus/sim/frame.h"

namespace acus::io {

std::string trace_csv_header();
std::string trace_csv_row(const Frame& frame);

std::string events_csv_header();
std::string events_csv_row(const Event& event);

}  // namespace acus::io
