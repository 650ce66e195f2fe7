// A step allocates nothing, whatever happens in it. This program counts every operator new.
#include <gtest/gtest.h>

#include <cstdlib>
#include <new>
#include <set>

#include "acus/sim/simulation.h"

namespace {
long allocations = 0;
}

// Not inlined, lest the compiler see a free for a new and warn of it.
[[gnu::noinline]] void* operator new(std::size_t size) {
  ++allocations;
  if (void* memory = std::malloc(size ? size : 1)) return memory;
  throw std::bad_alloc();
}
[[gnu::noinline]] void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  ++allocations;
  return std::malloc(size ? size : 1);
}
[[gnu::noinline]] void* operator new(std::size_t size, std::align_val_t alignment) {
  ++allocations;
  const auto a = static_cast<std::size_t>(alignment);
  if (void* memory = std::aligned_alloc(a, (size + a - 1) / a * a)) return memory;
  throw std::bad_alloc();
}
[[gnu::noinline]] void operator delete(void* memory) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::align_val_t) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::size_t, std::align_val_t) noexcept {
  std::free(memory);
}

namespace acus {
namespace {

TEST(Allocation, is_seen_by_this_program) {
  const long before = allocations;
  std::vector<double> some(1000);
  EXPECT_EQ(allocations, before + 1);
  EXPECT_EQ(some[7], 0.0);
}

class StepAllocation : public ::testing::TestWithParam<std::pair<Element, Coupling>> {};
INSTANTIATE_TEST_SUITE_P(, StepAllocation,
                         ::testing::Values(std::pair{Element::nodal_pressure, Coupling::embedded},
                                           std::pair{Element::linear, Coupling::embedded},
                                           std::pair{Element::linear, Coupling::nearest_node}));

// In and out again in 400 steps: contact, puncture, cutting, withdrawal.
TEST_P(StepAllocation, is_none_through_contact_puncture_and_withdrawal) {
  Scene scene;
  scene.tissue.tetrahedra = 600;
  scene.tissue.element = GetParam().first;
  scene.contact.coupling = GetParam().second;
  scene.contact.rupture_force = 0.5;  // N
  auto built = Simulation::build(scene);
  ASSERT_TRUE(built.ok()) << built.error().sentence;
  Simulation simulation = std::move(*built);
  std::set<Stage> stages;
  const double stride = 0.2e-3;  // m
  for (int step = 1; step <= 400; ++step) {
    const double travel = stride * (step <= 200 ? step : 400 - step) - 5e-3;
    const long before = allocations;
    const Frame& frame = simulation.step(travel);
    const long after = allocations;
    ASSERT_EQ(after, before) << "step " << step;
    ASSERT_EQ(frame.health, Health::good) << "step " << step;
    stages.insert(frame.stage);
  }
  EXPECT_TRUE(stages.contains(Stage::free));
  EXPECT_TRUE(stages.contains(Stage::contact) || stages.contains(Stage::buckled));
  EXPECT_TRUE(stages.contains(Stage::inserted));
  EXPECT_TRUE(stages.contains(Stage::withdrawn));
}

}  // namespace
}  // namespace acus
