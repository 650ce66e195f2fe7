// A whole session by commands, through contact, buckling, puncture and withdrawal, byte for byte. The script
// and the record are shared with the engine in a browser (bindings/wasm/test), which must give the same.
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <set>

#include "acus/base/hash.h"
#include "acus/view/studio_session.h"

namespace acus::view {
namespace {

using Json = nlohmann::json;

struct Heard {
  std::uint64_t hash = hash_seed;  // of every frame and report but hello, in order
  std::set<std::string> events;

  void take(std::string_view bytes) { hash = hash_of_bytes(bytes, hash); }
  void listen(StudioSession& session) {
    while (const auto report = session.next_report()) {
      const Json json = Json::parse(*report);
      if (json["type"] == "event") events.insert(json["event"].get<std::string>());
      take(*report);
    }
    const auto frame = session.frame();
    take({reinterpret_cast<const char*>(frame.data()), frame.size()});
  }
};

Heard play(const std::string& path) {
  StudioSession session({"wasm", std::nullopt, build_without_files});
  session.next_report();
  Heard heard;
  std::ifstream script(path);
  for (std::string line; std::getline(script, line);) {
    const Json order = Json::parse(line);
    if (order.contains("type")) {
      session.take(line);
      heard.listen(session);
      continue;
    }
    for (int i = 0; i < order.at("times"); ++i) {
      session.advance(order.at("advance_s"));
      heard.listen(session);
    }
  }
  return heard;
}

TEST(WholeSession, gives_the_recorded_bytes) {
  const std::string folder = ACUS_SOURCE_DIR "/tests/view/";
  const Heard heard = play(folder + "session.jsonl");
  EXPECT_EQ(heard.events, (std::set<std::string>{"buckling", "contact", "exit", "puncture", "second_buckling",
                                                 "straightening"}));
  std::ifstream record(folder + "session_hash.txt");
  std::string hash;
  record >> hash;
  EXPECT_EQ(hex(heard.hash), hash);
}

}  // namespace
}  // namespace acus::view
