#include "acus/io/trace_csv.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <sstream>

namespace acus::io {
namespace {

std::vector<std::string> cells(const std::string& line) {
  std::vector<std::string> all;
  std::istringstream stream(line.substr(0, line.size() - 1));
  for (std::string cell; std::getline(stream, cell, ',');) all.push_back(cell);
  return all;
}

// The published list of columns, which scripts rely on.
constexpr const char* published =
    "time_s,hand_travel_m,hand_force_N,energy_force_N,tip_force_N,tip_depth_m,inserted_length_m,free_length_"
    "m,"
    "critical_load_N,deflection_m,stage,work_hand_J,energy_tissue_J,energy_needle_J,energy_kinetic_J,work_"
    "cutting_J,"
    "work_friction_J,work_damping_J,work_numerical_J,energy_residual_J,solver_iterations";

TEST(TraceCsv, begins_with_the_published_columns_in_their_order) {
  EXPECT_EQ(trace_csv_header().find(published), 0U) << trace_csv_header();
  EXPECT_EQ(events_csv_header(), "time_s,event,hand_travel_m,hand_force_N,free_length_m\n");
}

TEST(TraceCsv, every_value_stands_under_its_own_name_and_reads_back_to_the_bit) {
  Frame frame;
  const std::vector<std::pair<std::string, double*>> numbers = {
      {"time_s", &frame.time},
      {"hand_travel_m", &frame.hand_travel},
      {"hand_force_N", &frame.hand_force},
      {"energy_force_N", &frame.energy_force},
      {"tip_force_N", &frame.tip_force},
      {"tip_depth_m", &frame.tip_depth},
      {"inserted_length_m", &frame.inserted_length},
      {"free_length_m", &frame.free_length},
      {"critical_load_N", &frame.critical_load},
      {"deflection_m", &frame.deflection},
      {"work_hand_J", &frame.ledger.work_hand},
      {"energy_tissue_J", &frame.ledger.energy_tissue},
      {"energy_needle_J", &frame.ledger.energy_needle},
      {"energy_kinetic_J", &frame.ledger.energy_kinetic},
      {"energy_contact_J", &frame.ledger.energy_contact},
      {"work_cutting_J", &frame.ledger.work_cutting},
      {"work_friction_J", &frame.ledger.work_friction},
      {"work_damping_J", &frame.ledger.work_damping},
      {"work_numerical_J", &frame.ledger.work_numerical},
      {"work_snap_J", &frame.ledger.work_snap},
      {"work_relaxation_J", &frame.ledger.work_relaxation},
      {"energy_residual_J", &frame.energy_residual},
      {"tip_aside_m", &frame.tip_aside},
      {"shaft_force_N", &frame.shaft_force},
      {"hub_force_x_N", &frame.hub_force.x()},
      {"hub_force_y_N", &frame.hub_force.y()},
      {"hub_force_z_N", &frame.hub_force.z()},
      {"hub_moment_x_Nm", &frame.hub_moment.x()},
      {"hub_moment_y_Nm", &frame.hub_moment.y()},
      {"hub_moment_z_Nm", &frame.hub_moment.z()},
  };
  for (std::size_t i = 0; i < numbers.size(); ++i)
    *numbers[i].second = std::sqrt(2.0 + static_cast<double>(i)) * 1e-3;
  frame.stage = Stage::inserted_buckled;
  frame.solver_iterations = 17;

  const auto names = cells(trace_csv_header()), values = cells(trace_csv_row(frame));
  ASSERT_EQ(names.size(), values.size());
  ASSERT_EQ(names.size(), numbers.size() + 2);
  const auto under = [&](const std::string& name) {
    return values.at(static_cast<std::size_t>(std::find(names.begin(), names.end(), name) - names.begin()));
  };
  for (const auto& [name, value] : numbers)
    EXPECT_EQ(std::strtod(under(name).c_str(), nullptr), *value) << name;
  EXPECT_EQ(under("stage"), "inserted_buckled");
  EXPECT_EQ(under("solver_iterations"), "17");
}

TEST(TraceCsv, events_carry_their_published_names) {
  const Event event{.time = 1.5,
                    .kind = EventKind::second_buckling,
                    .hand_travel = 0.03,
                    .hand_force = 0.7,
                    .free_length = 0.17};
  EXPECT_EQ(events_csv_row(event), "1.5,second_buckling,0.03,0.7,0.17\n");
}

}  // namespace
}  // namespace acus::io
