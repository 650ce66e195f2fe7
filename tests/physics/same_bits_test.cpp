// The same scene gives the same bits: run after run, with g++ and clang, optimised or with sanitizers, and in
// a browser (bindings/wasm/test).
#include <fstream>
#include <map>

#include "acus/base/hash.h"
#include "acus/io/scene_toml.h"
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
#endif

TEST(SameBits, on_every_compiler_and_build_type) {
  EXPECT_EQ(recorded().size(), 5U);
  for (const auto& [name, hash] : recorded()) EXPECT_EQ(hex(insert(scene(name)).hash), hash) << name;
}

}  // namespace
