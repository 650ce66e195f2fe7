#include "acus/view/frame_bytes.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cstring>

#include "acus/io/trace_columns.h"

namespace acus::view {
namespace {

static_assert(__BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__, "frames are little-endian, and so is this machine");

class Writer {
 public:
  explicit Writer(std::span<std::byte> out) : out_(out) {}

  template <class Number>
  void put(Number value) {
    std::memcpy(out_.data() + at_, &value, sizeof value);
    at_ += sizeof value;
  }
  void put_points(std::span<const Vec3> points) {
    for (const Vec3& x : points)
      for (int c = 0; c < 3; ++c) put(static_cast<float>(x[c]));
  }
  std::size_t written() const { return at_; }

 private:
  std::span<std::byte> out_;
  std::size_t at_ = 0;
};

void put_numbers(Writer& writer, const Frame& frame) {
  const auto columns = io::trace_columns();
  assert(columns.size() == frame_numbers);
  for (const auto& column : columns) writer.put(column.value(frame));
}

// At a node the mean of the tetrahedra that meet there, by volume.
void stress_at_nodes(FrameScratch& s, const Simulation& simulation) {
  simulation.von_mises_into(s.stress);
  std::fill(s.node_stress.begin(), s.node_stress.end(), 0.0);
  const auto& tets = simulation.tissue().tets;
  for (std::size_t e = 0; e < tets.size(); ++e)
    for (const int node : tets[e]) s.node_stress[node] += s.tet_volume[e] * s.stress[e];
  for (std::size_t i = 0; i < s.node_stress.size(); ++i)
    if (s.volume_at_node[i] > 0.0) s.node_stress[i] /= s.volume_at_node[i];
}

}  // namespace

FrameScratch build_frame_scratch(const Simulation& simulation) {
  const mesh::TetMesh& mesh = simulation.tissue();
  FrameScratch s;
  s.needle.resize(needle_points);
  s.stress.resize(mesh.tets.size());
  s.node_stress.resize(mesh.nodes.size());
  s.volume_at_node.resize(mesh.nodes.size());
  for (const mesh::Tet& tet : mesh.tets) {
    s.tet_volume.push_back(mesh::signed_volume(mesh, tet));
    for (const int node : tet) s.volume_at_node[node] += s.tet_volume.back();
  }
  return s;
}

std::size_t frame_size(const Simulation& simulation) {
  const std::size_t nodes = simulation.tissue().nodes.size();
  return frame_head + frame_numbers * sizeof(double) + 3 * sizeof(float) * (needle_points + nodes) +
         sizeof(float) * nodes;
}

void frame_into(std::span<std::byte> out, const Simulation& simulation, FrameScratch& scratch) {
  assert(out.size() == frame_size(simulation));
  Writer writer(out);
  writer.put(frame_mark);
  writer.put(static_cast<std::uint32_t>(needle_points));
  writer.put(static_cast<std::uint32_t>(simulation.tissue().nodes.size()));
  writer.put(static_cast<std::uint32_t>(simulation.events().size()));
  put_numbers(writer, simulation.frame());
  simulation.needle_line_into(scratch.needle);
  writer.put_points(scratch.needle);
  writer.put_points(simulation.positions());
  stress_at_nodes(scratch, simulation);
  for (const double stress : scratch.node_stress) writer.put(static_cast<float>(stress));
  assert(writer.written() == out.size());
}

}  // namespace acus::view
