// A moment of a simulation as the bytes of docs/studio-protocol.md: numbers, needle, nodes and stress.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "acus/sim/simulation.h"

namespace acus::view {

inline constexpr std::uint32_t frame_mark = 0x46434131;  // "1ACF" in memory
inline constexpr int frame_numbers = 32;                 // the columns of a trace
inline constexpr int frame_head = 16;                    // bytes before them
inline constexpr int needle_points = 121;

// What writing frames of one simulation needs, sized once.
struct FrameScratch {
  std::vector<Vec3> needle;            // m
  std::vector<double> stress;          // Pa, of the tetrahedra
  std::vector<double> node_stress;     // Pa m^3, then Pa
  std::vector<double> tet_volume;      // m^3, at rest
  std::vector<double> volume_at_node;  // m^3, of the tetrahedra that meet there
};
FrameScratch build_frame_scratch(const Simulation& simulation);

// Bytes of every frame of this simulation.
std::size_t frame_size(const Simulation& simulation);

// Writes the present moment into `out` of frame_size() bytes. Allocates nothing.
void frame_into(std::span<std::byte> out, const Simulation& simulation, FrameScratch& scratch);

}  // namespace acus::view
