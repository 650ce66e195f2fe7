#include "acus/io/trace_columns.h"

#include <array>

#include "acus/sim/names.h"

namespace acus::io {
namespace {

#define ACUS_NUMBER(member) [](const auto& r) { return static_cast<double>(r.member); }

constexpr std::array of_frames = {
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
    Column<Frame>{"stage", ACUS_NUMBER(stage), [](const Frame& f) { return name_of(f.stage); }},
    Column<Frame>{"work_hand_J", ACUS_NUMBER(ledger.work_hand)},
    Column<Frame>{"energy_tissue_J", ACUS_NUMBER(ledger.energy_tissue)},
    Column<Frame>{"energy_needle_J", ACUS_NUMBER(ledger.energy_needle)},
    Column<Frame>{"energy_kinetic_J", ACUS_NUMBER(ledger.energy_kinetic)},
    Column<Frame>{"work_cutting_J", ACUS_NUMBER(ledger.work_cutting)},
    Column<Frame>{"work_friction_J", ACUS_NUMBER(ledger.work_friction)},
    Column<Frame>{"work_damping_J", ACUS_NUMBER(ledger.work_damping)},
    Column<Frame>{"work_numerical_J", ACUS_NUMBER(ledger.work_numerical)},
    Column<Frame>{"energy_residual_J", ACUS_NUMBER(energy_residual)},
    Column<Frame>{"solver_iterations", ACUS_NUMBER(solver_iterations)},
    Column<Frame>{"energy_contact_J", ACUS_NUMBER(ledger.energy_contact)},
    Column<Frame>{"work_snap_J", ACUS_NUMBER(ledger.work_snap)},
    Column<Frame>{"work_relaxation_J", ACUS_NUMBER(ledger.work_relaxation)},
    Column<Frame>{"tip_aside_m", ACUS_NUMBER(tip_aside)},
    Column<Frame>{"shaft_force_N", ACUS_NUMBER(shaft_force)},
    Column<Frame>{"hub_force_x_N", ACUS_NUMBER(hub_force.x())},
    Column<Frame>{"hub_force_y_N", ACUS_NUMBER(hub_force.y())},
    Column<Frame>{"hub_force_z_N", ACUS_NUMBER(hub_force.z())},
    Column<Frame>{"hub_moment_x_Nm", ACUS_NUMBER(hub_moment.x())},
    Column<Frame>{"hub_moment_y_Nm", ACUS_NUMBER(hub_moment.y())},
    Column<Frame>{"hub_moment_z_Nm", ACUS_NUMBER(hub_moment.z())},
};

constexpr std::array of_events = {
    Column<Event>{"time_s", ACUS_NUMBER(time)},
    Column<Event>{"event", ACUS_NUMBER(kind), [](const Event& e) { return name_of(e.kind); }},
    Column<Event>{"hand_travel_m", ACUS_NUMBER(hand_travel)},
    Column<Event>{"hand_force_N", ACUS_NUMBER(hand_force)},
    Column<Event>{"free_length_m", ACUS_NUMBER(free_length)},
};

#undef ACUS_NUMBER

}  // namespace

std::span<const Column<Frame>> trace_columns() { return of_frames; }
std::span<const Column<Event>> event_columns() { return of_events; }

}  // namespace acus::io
