// The columns of a trace: the one table that text (trace.csv) and bytes (frames of the studio) follow.
#pragma once

#include <span>
#include <string>

#include "acus/sim/frame.h"

namespace acus::io {

template <class Record>
struct Column {
  const char* name;                              // with its unit
  double (*value)(const Record&);                // SI; of a word, its place in the enumeration
  std::string (*word)(const Record&) = nullptr;  // where text shows a word
};

// The order is fixed: scripts and pages read these columns. New ones go to the end.
std::span<const Column<Frame>> trace_columns();
std::span<const Column<Event>> event_columns();

}  // namespace acus::io
