#include "acus/haptics/device_limits.h"

#include <cassert>

#include "acus/base/units.h"
#include "acus/haptics/devices_text.h"
#include "acus/io/toml_document.h"

namespace acus::haptics {
namespace {

// The text is part of the program, and tests read every row: what is missing here is a broken build.
double number(const toml::table& row, const char* key, double otherwise = 0.0) {
  return row[key].value_or(otherwise);
}

DeviceLimits limits_of(const std::string& name, const toml::table& row) {
  DeviceLimits limits;
  limits.name = name;
  limits.title = row["title"].value_or(std::string());
  limits.source = row["source"].value_or(std::string());
  limits.peak_force = number(row, "peak_N");
  limits.continuous_force = number(row, "continuous_N");
  limits.peak_torque = number(row, "peak_torque_N_m");
  limits.stiffness = number(row, "stiffness_N_m");
  limits.mass = number(row, "mass_kg");
  limits.viscous = number(row, "viscous_N_s_m");
  limits.coulomb = number(row, "coulomb_N");
  limits.quantum = number(row, "quantum_mm") * units::mm;
  limits.delay = number(row, "delay_ms") * units::ms;
  if (const toml::array* forward = row["forward"].as_array())
    for (int i = 0; i < 3; ++i) limits.forward[i] = (*forward)[static_cast<std::size_t>(i)].value_or(0.0);
  return limits;
}

std::vector<DeviceLimits> read_rows() {
  const Result<toml::table> table = io::parse_toml(devices_text, "devices.toml");
  assert(table.ok());
  std::vector<DeviceLimits> rows;
  for (const auto& [name, row] : *table)
    if (const toml::table* values = row.as_table())
      rows.push_back(limits_of(std::string(name.str()), *values));
  return rows;
}

}  // namespace

const std::vector<DeviceLimits>& known_devices() {
  static const std::vector<DeviceLimits> rows = read_rows();
  return rows;
}

const DeviceLimits* find_device_limits(const std::string& name) {
  for (const DeviceLimits& row : known_devices())
    if (row.name == name) return &row;
  return nullptr;
}

}  // namespace acus::haptics
