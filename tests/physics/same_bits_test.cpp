// The same scene gives the same bits: run after run, with g++ and clang, optimised or with sanitizers, with
// any number of threads, and in a browser (bindings/wasm/test).
#include <fstream>
#include <map>

#include "acus/base/hash.h"
#include "acus/io/scene_toml.h"
#include "acus/numeric/simd.h"
#include "insertion.h"

using namespace acus;
using namespace acus::physics;

namespace {

const std::string folder = ACUS_SOURCE_DIR "/tests/physics/";

// The file holds what g++ -O3 gave; every other build must give the same. It changes only together with the
// numbers themselves, and CHANGELOG says so.
std::map<std::string, std::string> recorded() {
  std::ifstream file(folder + "state_hashes.txt");
  std::map<std::string, std::string> all;
  for (std::string name, value; file >> name >> value;) all[name] = value;
  return all;
}

Scene scene(const std::string& name) {
  const auto read = io::read_scene(folder + "same_bits/" + name + ".toml");
  if (!read) ADD_FAILURE() << read.error().sentence;
  return read ? *read : Scene{};
}

#ifndef ACUS_SANITIZED  // where an insertion takes half a minute
TEST(SameBits, run_after_run) {
  for (const auto& [name, hash] : recorded())
    EXPECT_EQ(insert(scene(name)).hash, insert(scene(name)).hash) << name;
}

TEST(SameBits, by_registers_of_any_width) {
  int& bytes = numeric::kernels::register_bytes;
  const int widest = bytes;
  for (bytes = 16; bytes <= widest; bytes *= 2)
    for (const auto& [name, hash] : recorded())
      EXPECT_EQ(hex(insert(scene(name)).hash), hash) << name << " by " << bytes << " bytes";
  bytes = widest;
}
#endif

TEST(SameBits, on_every_compiler_and_build_type) {
  EXPECT_EQ(recorded().size(), 7U);
  for (const auto& [name, hash] : recorded()) EXPECT_EQ(hex(insert(scene(name)).hash), hash) << name;
}

// Of meshes whose elements come in several streams.
TEST(SameBits, for_any_number_of_threads) {
#ifdef ACUS_SANITIZED
  const std::vector<int> of_threads = {2};
#else
  const std::vector<int> of_threads = {1, 2, 4, 1, 2, 4, 1, 2, 4};
#endif
  for (const char* name : {"large", "large_exact"})
    for (const int threads : of_threads) {
      const Insertion run = insert(scene(name), {}, Health::good, threads);
      EXPECT_EQ(hex(run.hash), recorded()[name]) << name << ", " << threads << " threads";
      EXPECT_TRUE(run.first(EventKind::puncture)) << "it should cut too";
    }
}

TEST(SameBits, asks_for_a_number_of_threads_that_there_can_be) {
  for (const int threads : {-1, 0, 65}) {
    const auto refused = Simulation::build(Scene{}, nullptr, threads);
    ASSERT_FALSE(refused.ok());
    EXPECT_EQ(refused.error().sentence,
              "a step can be shared by 1 to 64 threads, not by " + std::to_string(threads));
  }
}

}  // namespace
