// A served device whose sessions are written down: what the files hold, and what becomes of those that were
// there before.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "acus/io/recording.h"
#include "acus/io/replay.h"
#include "page.h"

namespace acus::app {
namespace {

namespace fs = std::filesystem;

class RecordedSession : public testing::Test {
 protected:
  void SetUp() override {
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  std::string file(const std::string& name) const { return (folder_ / name).string(); }

  std::unique_ptr<Engine> recording_into(const std::string& name) const {
    return engine_with_device({0.0, file(name)});
  }

 private:
  fs::path folder_ = fs::temp_directory_path() / ("acus_recorded_" + std::to_string(getpid()));
};

// A page arms the device and waits until the needle is felt.
void feel(Page& page) {
  double force = 0.0;
  for (int i = 0; i < 300 && force < 0.3; ++i) {
    page.say({{"type", "arm"}});  // again where a busy machine has cost the force
    force = page.next("loop")["device_force_N"];
  }
  EXPECT_GE(force, 0.3);
}

bool has(const Simulation& simulation, EventKind kind) {
  return std::any_of(simulation.events().begin(), simulation.events().end(),
                     [kind](const Event& event) { return event.kind == kind; });
}

// A whole recording whose every state comes out again; the simulation at its end.
Simulation replayed(const std::string& file) {
  const io::Recording recording = io::read_recording(file, io::Ticks::read).value();
  EXPECT_TRUE(recording.whole) << recording.loss;
  EXPECT_FALSE(recording.ticks.empty());
  Simulation again = io::build_replay(recording).value();
  io::HashCheck check(recording);
  bool same = check(again);
  for (const double travel : recording.travels) {
    again.step(travel);
    same = check(again) && same;
  }
  EXPECT_TRUE(same);
  EXPECT_EQ(check.compared(), static_cast<int>(recording.hashes.size()));
  return again;
}

TEST_F(RecordedSession, comes_out_again_to_the_same_bits) {
  {
    const Running server(recording_into("hand.acusrec"));
    Page page(server);
    feel(page);
  }
  const Simulation again = replayed(file("hand.acusrec"));
  EXPECT_TRUE(has(again, EventKind::contact));
  EXPECT_EQ(again.scene().needle.length, bare_column().needle.length);
}

TEST_F(RecordedSession, has_a_file_for_each_insertion) {
  std::ofstream(file("hand-2.acusrec")) << "of another day";
  {
    const Running server(recording_into("hand.acusrec"));
    Page page(server);
    feel(page);
    for (const double length : {150.0, 120.0}) {
      page.say({{"type", "start"},
                {"scene", "tissue.rigid = true\nneedle.length_mm = " + std::to_string(length)}});
      do {
      } while (page.next("model")["needle_length_m"] != 1e-3 * length);
      constexpr std::size_t time = 0;
      while (page.number(time) < 0.05) {
      }
    }
  }
  EXPECT_EQ(replayed(file("hand.acusrec")).scene().needle.length, 0.2);
  EXPECT_EQ(replayed(file("hand-3.acusrec")).scene().needle.length, 0.15);
  EXPECT_EQ(replayed(file("hand-4.acusrec")).scene().needle.length, 0.12);
  std::string kept;
  std::getline(std::ifstream(file("hand-2.acusrec")), kept);
  EXPECT_EQ(kept, "of another day");
}

TEST_F(RecordedSession, says_on_the_page_that_the_next_insertion_is_not_recorded) {
  const auto engine = recording_into("gone/hand.acusrec");
  fs::create_directory(file("gone"));
  const auto server = StudioServer::start(0, *engine).value();
  fs::remove_all(file("gone"));
  std::atomic<bool> stop{false};
  std::optional<Error> failed;
  std::thread running([&] { failed = server->run(stop); });
  Page page(*server);
  page.next("model");
  page.say({{"type", "start"}, {"scene", "tissue.rigid = true"}});
  EXPECT_NE(page.next("refused")["sentence"].get<std::string>().find("this insertion is not recorded"),
            std::string::npos);
  page.next("loop");
  stop = true;
  running.join();
  ASSERT_TRUE(failed);  // and the program says it once more when it ends
  EXPECT_NE(failed->sentence.find("gone"), std::string::npos) << failed->sentence;
}

// As when somebody starts the program twice.
TEST_F(RecordedSession, leaves_a_recording_alone_where_the_port_is_taken) {
  const Running server(recording_into("hand.acusrec"));
  const auto size = fs::file_size(file("hand.acusrec"));
  const auto engine = recording_into("hand.acusrec");
  EXPECT_FALSE(StudioServer::start(server.port(), *engine));
  Page page(server);
  page.next("loop");
  while (fs::file_size(file("hand.acusrec")) <= size)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
}

TEST_F(RecordedSession, is_refused_where_there_is_no_such_folder) {
  const auto engine = recording_into("nowhere/hand.acusrec");
  const auto server = StudioServer::start(0, *engine);
  ASSERT_FALSE(server);
  EXPECT_NE(server.error().sentence.find("nowhere"), std::string::npos) << server.error().sentence;
}

}  // namespace
}  // namespace acus::app
