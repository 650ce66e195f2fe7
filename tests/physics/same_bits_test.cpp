// The same scene gives the same bits: run after run, with g++ and clang, optimised or with sanitizers.
#include <fstream>
#include <map>

#include "acus/base/hash.h"
#include "insertion.h"

using namespace acus;
using namespace acus::physics;

namespace {

std::map<std::string, Scene> scenes() {
  std::map<std::string, Scene> all;
  Scene snap = table_one(0.2, 32e-3, 50e-3, 1000);
  snap.contact.rupture_force = 0.66;
  snap.contact.friction = 20.0;
  all["snap"] = snap;
  Scene paper = table_one(0.15, 15e-3, 30e-3, 1000);
  paper.tissue.element = Element::linear;
  paper.contact.coupling = Coupling::nearest_node;
  all["paper"] = paper;
  Scene back = table_one(0.15, 20e-3, 40e-3, 600);  // withdraws from its channel and enters it again
  back.hand.kind = HandKind::path;
  back.hand.path = {{0.0, 0.0}, {0.4, 18e-3}, {0.45, 18e-3}, {0.75, 3e-3}, {0.95, 12e-3}};
  all["withdrawal"] = back;
  return all;
}

#ifndef ACUS_SANITIZED  // where an insertion takes half a minute
TEST(SameBits, run_after_run) {
  for (const auto& [name, scene] : scenes()) EXPECT_EQ(insert(scene).hash, insert(scene).hash) << name;
}
#endif

// The file holds what g++ -O3 gave; every other build must give the same. It changes only together with the
// numbers themselves, and CHANGELOG says so.
TEST(SameBits, on_every_compiler_and_build_type) {
  std::ifstream file(ACUS_SOURCE_DIR "/tests/physics/state_hashes.txt");
  std::map<std::string, std::string> recorded;
  for (std::string name, value; file >> name >> value;) recorded[name] = value;
  for (const auto& [name, scene] : scenes()) EXPECT_EQ(hex(insert(scene).hash), recorded[name]) << name;
}

}  // namespace
