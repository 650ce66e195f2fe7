// What a large tissue takes of the heap.
#include <gtest/gtest.h>

#include "acus/sim/simulation.h"
#include "tests/counted_allocations.h"

namespace acus {
namespace {

class Memory : public ::testing::TestWithParam<double> {};
INSTANTIATE_TEST_SUITE_P(elastic_and_relaxing, Memory, ::testing::Values(0.0, 0.4));

// Model, state and scratch together, at the most that building takes and afterwards.
TEST_P(Memory, of_a_hundred_thousand_tetrahedra_is_below_200_MB) {
  constexpr long most = 200'000'000;  // bytes
  Scene scene;
  scene.tissue.tetrahedra = 103000;  // the block has a few less
  scene.tissue.relaxation_share = GetParam();
  const long before = live_bytes;
  most_live_bytes = before;
  auto simulation = Simulation::build(scene);
  ASSERT_TRUE(simulation.ok()) << simulation.error().sentence;
  simulation->step(1e-3);
  ASSERT_GE(simulation->tissue().tets.size(), 100000u);
  EXPECT_LT(most_live_bytes - before, most);
  // At the least the corners of the tetrahedra, lest a hook that sees nothing pass.
  EXPECT_GT(live_bytes - before, static_cast<long>(sizeof(mesh::Tet) * simulation->tissue().tets.size()));
  RecordProperty("live_bytes", std::to_string(live_bytes - before));
  RecordProperty("tetrahedra", std::to_string(simulation->tissue().tets.size()));
}

}  // namespace
}  // namespace acus
