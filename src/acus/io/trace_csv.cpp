#include "acus/io/trace_csv.h"

#include "acus/base/decimal.h"
#include "acus/io/trace_columns.h"

namespace acus::io {
namespace {

// One cell per column, joined by commas, as one line.
template <class Record, class Text>
std::string line_of(std::span<const Column<Record>> columns, const Text& text) {
  std::string line;
  for (const Column<Record>& column : columns) {
    line += text(column);
    line += ',';
  }
  line.back() = '\n';
  return line;
}

template <class Record>
std::string header(std::span<const Column<Record>> columns) {
  return line_of(columns, [](const auto& column) { return std::string(column.name); });
}

template <class Record>
std::string row(std::span<const Column<Record>> columns, const Record& record) {
  return line_of(columns, [&](const auto& column) {
    return column.word != nullptr ? column.word(record) : decimal_text(column.value(record));
  });
}

}  // namespace

std::string trace_csv_header() { return header(trace_columns()); }
std::string trace_csv_row(const Frame& frame) { return row(trace_columns(), frame); }
std::string events_csv_header() { return header(event_columns()); }
std::string events_csv_row(const Event& event) { return row(event_columns(), event); }

}  // namespace acus::io
