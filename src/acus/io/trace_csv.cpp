#include "acus/io/trace_csv.h"

#include <array>

#include "acus/base/decimal.h"
#include "acus/sim/names.h"

namespace acus::io {
namespace {

template <class Record>
struct Column {
  const char* name;
  std::string (*text)(const Record&);
};

// The cells joined by commas, as one line.
template <class Cells, class Text>
std::string line_of(const Cells& cells, const Text& text) {
  std::string line;
  for (const auto& cell : cells) {
    line += text(cell);
    line += ',';
  }
  line.back() = '\n';
  return line;
}

template <class Columns>
std::string header(const Columns& columns) {
  return line_of(columns, [](const auto& column) { return std::string(column.name); });
}

template <class Columns, class Record>
std::string row(const Columns& columns, const Record& record) {
  return line_of(columns, [&](const auto& column) { return column.text(record); });
}

#define ACUS_NUMBER(member) [](const auto& r) { return decimal_text(r.member); }

// The order is fixed: scripts read these columns. New ones go to the end.
constexpr std::array trace_columns = {
    Column<Frame>{"time_s", ACUS_NUMBER(time)},
    Column<Frame>{"hand_travel_m", ACUS_NUMBER(hand_travel)},
    Column<Frame>{"hand_force_N", ACUS_NUMBER(hand_force)},
    Column<Frame>{"energy_force_N", ACUS_NUMBER(energy_force)},
    Column<Frame>{"tip_force_N", ACUS_NUMBER(tip_force)},
    Column<Frame>{"tip_depth_m", ACUS_NUMBER(tip_depth)},
    Column<Frame>{"inserted_length_m", ACUS_NUMBER(inserted_length)},
    Column<Frame>{"free_length_m", ACUS_NUMBER(free_length)},
    Column<Frame>{"critical_load_N", ACUS_NUMBER(critical_load)},
    Column<Frame>{"deflection_m", ACUS_NUMBER(deflection)},
    Column<Frame>{"stage", [](const Frame& f) { return name_of(f.stage); }},
    Column<Frame>{"work_hand_J", ACUS_NUMBER(ledger.work_hand)},
    Column<Frame>{"energy_tissue_J", ACUS_NUMBER(ledger.energy_tissue)},
    Column<Frame>{"energy_needle_J", ACUS_NUMBER(ledger.energy_needle)},
    Column<Frame>{"energy_kinetic_J", ACUS_NUMBER(ledger.energy_kinetic)},
    Column<Frame>{"work_cutting_J", ACUS_NUMBER(ledger.work_cutting)},
    Column<Frame>{"work_friction_J", ACUS_NUMBER(ledger.work_friction)},
    Column<Frame>{"work_damping_J", ACUS_NUMBER(ledger.work_damping)},
    Column<Frame>{"work_numerical_J", ACUS_NUMBER(ledger.work_numerical)},
    Column<Frame>{"energy_residual_J", ACUS_NUMBER(energy_residual)},
    Column<Frame>{"solver_iterations", [](const Frame& f) { return std::to_string(f.solver_iterations); }},
    Column<Frame>{"energy_contact_J", ACUS_NUMBER(ledger.energy_contact)},
    Column<Frame>{"work_snap_J", ACUS_NUMBER(ledger.work_snap)},
};

constexpr std::array event_columns = {
    Column<Event>{"time_s", ACUS_NUMBER(time)},
    Column<Event>{"event", [](const Event& e) { return name_of(e.kind); }},
    Column<Event>{"hand_travel_m", ACUS_NUMBER(hand_travel)},
    Column<Event>{"hand_force_N", ACUS_NUMBER(hand_force)},
    Column<Event>{"free_length_m", ACUS_NUMBER(free_length)},
};

#undef ACUS_NUMBER

}  // namespace

std::string trace_csv_header() { return header(trace_columns); }
std::string trace_csv_row(const Frame& frame) { return row(trace_columns, frame); }
std::string events_csv_header() { return header(event_columns); }
std::string events_csv_row(const Event& event) { return row(event_columns, event); }

}  // namespace acus::io
