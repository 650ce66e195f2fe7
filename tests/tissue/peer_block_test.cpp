// Displacement histories on which SOFA (FastTetrahedralCorotational, polar), VegaFEM and a plain Eigen
// program agree: a block of 1 N pressed suddenly on the middle of its top.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "acus/io/mesh_file.h"
#include "tests/tissue/tissue_driver.h"

namespace acus::tissue {
namespace {

class PeerBlock : public ::testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(, PeerBlock, ::testing::Values("block_1k", "block_5k"));

TEST_P(PeerBlock, sinks_as_in_other_programs) {
  const char* given = std::getenv("ACUS_DATA");  // see CONTRIBUTING.md
  if (given == nullptr) GTEST_SKIP() << "ACUS_DATA names no folder of other programs' results";
  const auto base = std::filesystem::path(given) / "peer_block" / GetParam();
  const auto peer = nlohmann::json::parse(std::ifstream(base.string() + ".json"));
  const auto mesh = io::read_mesh(base.string() + ".msh", 1.0);
  ASSERT_TRUE(mesh.ok()) << mesh.error().sentence;
  ASSERT_EQ(mesh->nodes.size(), peer["nodes"].get<std::size_t>());
  ASSERT_EQ(mesh->tets.size(), peer["tetrahedra"].get<std::size_t>());
  std::vector<Vec3> loaded_at;
  for (int node : peer["loaded_nodes"]) loaded_at.push_back(mesh->nodes[static_cast<std::size_t>(node)]);
  const HeldMesh held = held_mesh(*mesh, at_bottom);
  BareTissue tissue(held, {peer["youngs_modulus_Pa"], peer["poisson_ratio"], peer["density_kg_m3"]},
                    ElementKind::linear);
  std::vector<int> loaded;
  for (const Vec3& point : loaded_at)
    loaded.push_back(
        static_cast<int>(std::find(tissue.rest.begin(), tissue.rest.end(), point) - tissue.rest.begin()));
  for (int node : loaded) {
    ASSERT_LT(node, held.free_nodes);
    numeric::at(tissue.load, node).z() =
        -peer["total_load_N"].get<double>() / static_cast<double>(loaded.size());
  }
  const auto& sinks = peer["mean_patch_sink_mm"];
  int compared = 0;
  for (int step = 1; compared < static_cast<int>(sinks.size()) && step <= 1000; ++step) {
    tissue.step(peer["time_step_s"]);
    const auto expected = sinks.find(std::to_string(step));
    if (expected == sinks.end()) continue;
    ++compared;
    double sink = 0.0;  // mm
    for (int node : loaded)
      sink += 1e3 * (tissue.rest[node].z() - tissue.position[node].z()) / static_cast<double>(loaded.size());
    RecordProperty("sink_mm_after_" + std::to_string(step), std::to_string(sink));
    EXPECT_NEAR(sink, expected->get<double>(), 2e-3 * expected->get<double>()) << "step " << step;
  }
  EXPECT_EQ(compared, 5);
}

}  // namespace
}  // namespace acus::tissue
