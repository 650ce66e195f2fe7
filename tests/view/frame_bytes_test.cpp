#include "acus/view/frame_bytes.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <cstring>
#include <sstream>

#include "acus/io/scene_toml.h"
#include "acus/io/trace_csv.h"
#include "tests/view/small_scene.h"

namespace acus::view {
namespace {

// The page's table, read on its own.
class ReadBack {
 public:
  explicit ReadBack(const std::vector<std::byte>& bytes) : bytes_(bytes) {}
  template <class Number>
  Number at(std::size_t byte) const {
    Number value;
    std::memcpy(&value, &bytes_.at(byte + sizeof value - 1) - (sizeof value - 1), sizeof value);
    return value;
  }
  std::size_t points() const { return at<std::uint32_t>(4); }
  std::size_t nodes() const { return at<std::uint32_t>(8); }
  Vec3 needle(std::size_t i) const { return vector(272 + 12 * i); }
  Vec3 node(std::size_t i) const { return vector(272 + 12 * (points() + i)); }
  double stress(std::size_t i) const { return at<float>(272 + 12 * (points() + nodes()) + 4 * i); }

 private:
  Vec3 vector(std::size_t byte) const { return {at<float>(byte), at<float>(byte + 4), at<float>(byte + 8)}; }
  const std::vector<std::byte>& bytes_;
};

Simulation built(const std::vector<std::string>& settings = {}) {
  const auto scene = io::parse_scene(small_scene, "scene", settings);
  auto simulation = Simulation::build(*scene);
  EXPECT_TRUE(simulation.ok());
  return std::move(*simulation);
}

std::vector<std::byte> frame_of(const Simulation& simulation) {
  FrameScratch scratch = build_frame_scratch(simulation);
  std::vector<std::byte> bytes(frame_size(simulation));
  frame_into(bytes, simulation, scratch);
  return bytes;
}

std::vector<std::string> cells(const std::string& line) {
  std::vector<std::string> all;
  std::istringstream stream(line.substr(0, line.size() - 1));
  for (std::string cell; std::getline(stream, cell, ',');) all.push_back(cell);
  return all;
}

void expect_near(const Vec3& a, const Vec3& b) { EXPECT_LT((a - b).norm(), 1e-8) << a << "\n" << b; }

class FrameNumbers : public ::testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(, FrameNumbers, ::testing::Values("tissue.rigid=false", "tissue.rigid=true"));

TEST_P(FrameNumbers, are_those_of_the_trace) {
  Simulation simulation = built({GetParam()});
  for (int step = 1; step <= 150; ++step) simulation.step(1e-4 * step);
  const std::vector<std::byte> bytes = frame_of(simulation);
  const ReadBack read(bytes);
  EXPECT_EQ(std::memcmp(bytes.data(), "1ACF", 4), 0);
  EXPECT_EQ(read.at<std::uint32_t>(12), simulation.events().size());
  EXPECT_GT(simulation.events().size(), 1U);
  const auto names = cells(io::trace_csv_header()), values = cells(io::trace_csv_row(simulation.frame()));
  const std::vector<std::string> stages = {"free",     "contact",          "buckled",
                                           "inserted", "inserted_buckled", "withdrawn"};
  ASSERT_EQ(names.size(), 32U);
  for (std::size_t i = 0; i < names.size(); ++i) {
    const double number = read.at<double>(16 + 8 * i);
    if (names[i] == "stage")
      EXPECT_EQ(stages.at(static_cast<std::size_t>(number)), values[i]);
    else
      EXPECT_EQ(number, std::strtod(values[i].c_str(), nullptr)) << names[i];
  }
}

TEST(FrameBytes, needle_goes_from_hub_to_tip_and_nodes_keep_their_order) {
  Simulation simulation = built();
  for (int step = 1; step <= 100; ++step) simulation.step(1e-4 * step);
  const std::vector<std::byte> bytes = frame_of(simulation);
  const ReadBack read(bytes);
  const Vec3 hub = simulation.entry() + (simulation.frame().hand_travel - 0.2) * simulation.direction();
  expect_near(read.needle(0), hub);
  const Vec3 tip = read.needle(read.points() - 1) - simulation.entry();
  EXPECT_NEAR(tip.dot(simulation.direction()), simulation.frame().tip_depth, 1e-6);
  EXPECT_NEAR(tip.cross(simulation.direction()).norm(), simulation.frame().tip_aside, 1e-6);
  ASSERT_EQ(read.nodes(), simulation.tissue().nodes.size());
  EXPECT_EQ(bytes.size(), 272 + 12 * read.points() + 16 * read.nodes());
  for (std::size_t i = 0; i < read.nodes(); ++i) expect_near(read.node(i), simulation.positions()[i]);
}

TEST(FrameBytes, stress_at_a_node_is_the_mean_of_its_tetrahedra_by_volume) {
  Simulation simulation = built();
  for (int step = 1; step <= 100; ++step) simulation.step(1e-4 * step);
  const std::vector<std::byte> bytes = frame_of(simulation);
  const ReadBack read(bytes);
  const std::vector<double> stress = simulation.von_mises();
  const mesh::TetMesh& mesh = simulation.tissue();
  double highest = 0.0;
  for (std::size_t node = 0; node < mesh.nodes.size(); ++node) {
    double sum = 0.0, volume = 0.0;
    for (std::size_t e = 0; e < mesh.tets.size(); ++e)
      for (const int corner : mesh.tets[e])
        if (corner == static_cast<int>(node)) {
          const double v = mesh::signed_volume(mesh, mesh.tets[e]);
          sum += v * stress[e];
          volume += v;
        }
    EXPECT_NEAR(read.stress(node), sum / volume, 1e-6 * sum / volume);
    highest = std::max(highest, sum / volume);
  }
  EXPECT_GT(highest, 100.0);  // Pa: there is something to see
}

}  // namespace
}  // namespace acus::view
