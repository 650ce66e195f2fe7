// `acus run --record` and `acus replay` as a user meets them.
#include "acus/io/replay.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>

#include "acus/io/insertion.h"
#include "acus/io/summary_json.h"
#include "program.h"

namespace acus::io {
namespace {

using nlohmann::json;
namespace fs = std::filesystem;

std::string with_one_byte_changed(std::string bytes, std::size_t at) {
  bytes[at] = static_cast<char>(bytes[at] ^ 1);
  return bytes;
}

// A folder with hand.acusrec in it: 1200 steps into a small block of tissue, buckling on the way.
class Replay : public ::testing::Test {
 protected:
  Replay() : folder_(fresh_folder("replay")) {
    const ProgramRun run =
        run_program({"run", ACUS_SOURCE_DIR "/scenes/default.toml", "--set", "tissue.tetrahedra=300", "--set",
                     "hand.travel_mm=24", "--set", "hand.speed_mm_s=20", "--record", "hand.acusrec", "--json",
                     "--out", "recorded"},
                    folder_);
    EXPECT_EQ(run.exit_code, 0) << run.err;
    EXPECT_EQ(run.err, "");
    recorded_ = json::parse(run.out, nullptr, false);
  }
  ~Replay() override { fs::remove_all(folder_); }

  ProgramRun replay(std::vector<std::string> more) const {
    std::vector<std::string> words = {"replay"};
    words.insert(words.end(), more.begin(), more.end());
    return run_program(words, folder_);
  }
  std::string recording() const { return file_text(folder_ + "/hand.acusrec"); }
  void write(const std::string& name, const std::string& bytes) const {
    std::ofstream(folder_ + "/" + name, std::ios::binary) << bytes;
  }

  std::string folder_;
  json recorded_;
};

TEST_F(Replay, gives_the_same_bits_and_the_same_files) {
  const ProgramRun run = replay({"hand.acusrec", "--json", "--out", "replayed"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(run.err, "");
  const json replayed = json::parse(run.out);
  EXPECT_EQ(replayed["state_hash"], recorded_["state_hash"]);
  EXPECT_EQ(replayed["scene"], recorded_["scene"]);
  EXPECT_EQ(replayed["steps"], 1200);
  for (const char* name : {"/trace.csv", "/events.csv"})
    EXPECT_EQ(file_text(folder_ + "/replayed" + name), file_text(folder_ + "/recorded" + name)) << name;
  EXPECT_NE(replay({"hand.acusrec"}).out.find("The same bits: the 6 recorded states of 1200 steps"),
            std::string::npos);
  EXPECT_EQ(replay({"hand.acusrec", "--quiet"}).out, "");
}

// What a person does follows from what was felt; its recording holds what was done, and needs no feeling.
TEST_F(Replay, takes_a_persons_hand_to_the_same_bits) {
  const ProgramRun first =
      run_program({"run", ACUS_SOURCE_DIR "/scenes/default.toml", "--set", "tissue.tetrahedra=300", "--set",
                   "hand.kind=person", "--set", "hand.travel_mm=12", "--set", "hand.speed_mm_s=30", "--set",
                   "hand.stiffness_N_m=1000", "--record", "person.acusrec", "--json", "--out", "person"},
                  folder_);
  ASSERT_EQ(first.exit_code, 0) << first.err;
  const json recorded = json::parse(first.out);
  EXPECT_LT(recorded["steps"], 30000);  // done before hand.duration_s is over
  const ProgramRun again = replay({"person.acusrec", "--json", "--out", "person_again"});
  ASSERT_EQ(again.exit_code, 0) << again.err;
  EXPECT_EQ(json::parse(again.out)["state_hash"], recorded["state_hash"]);
  EXPECT_EQ(file_text(folder_ + "/person_again/trace.csv"), file_text(folder_ + "/person/trace.csv"));
}

// Clamped and pinned, 200 mm carry 0.642 N before they buckle and 300 mm only 0.285 N (Euler); this hand
// pushes harder. with more.
TEST_F(Replay, takes_the_same_hand_with_another_needle) {
  EXPECT_EQ(recorded_["predicted_loads_N"].empty(), false);
  const ProgramRun run =
      replay({"hand.acusrec", "--set", "needle.length_mm=300", "--json", "--out", "other"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const json other = json::parse(run.out);
  EXPECT_EQ(other["scene"]["needle"]["length_mm"], 300.0);
  EXPECT_NE(other["state_hash"], recorded_["state_hash"]);
  EXPECT_LT(other["peak_hand_force_N"], recorded_["peak_hand_force_N"]);
  EXPECT_NE(replay({"hand.acusrec", "--set", "needle.length_mm=300"}).out.find("nothing was compared"),
            std::string::npos);
  const ProgramRun wrong = replay({"hand.acusrec", "--set", "needle.lenght_mm=300"});
  EXPECT_EQ(wrong.exit_code, 2);
  EXPECT_NE(wrong.err.find("needle.length_mm"), std::string::npos) << wrong.err;
}

TEST_F(Replay, of_a_recording_that_was_cut_off_goes_as_far_as_it_does) {
  write("cut.acusrec", recording().substr(0, recording().size() - 10));  // within its end
  const ProgramRun cut = replay({"cut.acusrec"});
  EXPECT_EQ(cut.exit_code, 0);
  EXPECT_NE(cut.err.find("acus: cut.acusrec: byte "), std::string::npos) << cut.err;
  EXPECT_NE(cut.err.find("the recording ends at 1.200 s: its next block is cut off"), std::string::npos)
      << cut.err;
  EXPECT_NE(cut.out.find("The same bits"), std::string::npos) << cut.out;
}

// The same from within, in real time and with every lost step counted, is
// tests/haptics/recorder_kill_test.cpp.
TEST_F(Replay, of_a_run_that_was_killed_gives_the_bits_that_it_had) {
  for (const char* life : {"0.3", "0.6", "0.9"}) {
    fs::remove(folder_ + "/killed.acusrec");
    const std::string command = "cd " + folder_ + " && timeout -s KILL " + life +
                                " " ACUS_BUILD_DIR "/acus run " ACUS_SOURCE_DIR
                                "/scenes/default.toml --set tissue.tetrahedra=300 --set hand.speed_mm_s=0.1 "
                                "--record killed.acusrec --quiet > stdout.txt 2> stderr.txt";
    EXPECT_NE(std::system(command.c_str()), 0) << "it came to its end; make the hand slower";
    if (!fs::exists(folder_ + "/killed.acusrec")) continue;  // killed before its first step
    const ProgramRun run = replay({"killed.acusrec"});
    EXPECT_EQ(run.exit_code, 0) << run.err;
    EXPECT_NE(run.err.find("killed.acusrec: byte "), std::string::npos) << run.err;
    EXPECT_EQ(run.out.find("The same bits") != std::string::npos,
              run.err.find("ends at 0.000 s") == std::string::npos)
        << run.out << run.err;
  }
}

TEST_F(Replay, of_what_cannot_be_used_is_refused_in_one_sentence) {
  write("empty", "");
  write("notes", "notes of the user, longer than the head of a recording\n");
  write("head", recording().substr(0, 400));
  write("scene", with_one_byte_changed(recording(), 100));
  for (const auto& [name, said] : std::vector<std::pair<std::string, std::string>>{
           {"empty", "the file is empty"},
           {"notes", "byte 0: this is no recording"},
           {"head", "byte 16: the scene of the recording is missing or damaged"},
           {"scene", "byte 16: the scene of the recording is missing or damaged"},
           {"absent", "there is no such file"},
           {".", "is not a regular file"}}) {
    const ProgramRun run = replay({name});
    EXPECT_EQ(run.exit_code, 2) << name;
    EXPECT_EQ(run.err.rfind("acus: " + name + ": " + said, 0), 0U) << run.err;
    EXPECT_EQ(run.out, "");
  }
}

TEST_F(Replay, with_a_mesh_that_was_changed_is_refused) {
  const std::string mesh = file_text(ACUS_SOURCE_DIR "/tests/fixtures/meshes/gmsh_22.msh");
  write("tissue.msh", mesh);
  const ProgramRun run =
      run_program({"run", ACUS_SOURCE_DIR "/scenes/default.toml", "--set", "tissue.mesh=tissue.msh", "--set",
                   "hand.travel_mm=0.1", "--record", "mesh.acusrec", "--quiet"},
                  folder_);
  ASSERT_EQ(run.exit_code, 0) << run.err;
  fs::create_directory(folder_ + "/elsewhere");
  fs::rename(folder_ + "/mesh.acusrec", folder_ + "/elsewhere/mesh.acusrec");
  EXPECT_EQ(replay({"elsewhere/mesh.acusrec", "--quiet"}).exit_code, 0);
  write("tissue.msh", mesh + "\n");
  const ProgramRun changed = replay({"elsewhere/mesh.acusrec"});
  EXPECT_EQ(changed.exit_code, 2);
  EXPECT_NE(changed.err.find("tissue.msh: this mesh was changed after the recording was made"),
            std::string::npos)
      << changed.err;
}

// A recording of the bare column with a hash after each of three steps, as if the engine had given other
// bits.
struct Claim {
  std::vector<double> travels = {1e-5, 2e-5, 3e-5};  // m
  std::size_t false_hash = 99;                       // which of them is not the engine's
  std::string versions = json_text(versions_json());
};

std::string bytes_of(const Claim& claim) {
  Scene scene;
  scene.tissue.rigid = true;
  auto simulation = build_simulation(scene);
  RecordedSteps steps{1, claim.travels, {}};
  for (std::size_t i = 0; i < claim.travels.size(); ++i) {
    simulation->step(claim.travels[i]);
    steps.hashes.push_back({i + 1, simulation->state_hash() + (i == claim.false_hash ? 1 : 0)});
  }
  RecordedScene recorded = *recorded_scene(scene);
  recorded.versions = claim.versions;
  std::uint32_t checksum = recording_head_checksum();
  std::string bytes = recording_head() + block_bytes(recorded, checksum);
  bytes += block_bytes(steps, checksum);
  return bytes + block_bytes(RecordedEnd{steps.hashes.back()}, checksum);
}

TEST_F(Replay, that_differs_names_the_first_step_that_does) {
  write("true.acusrec", bytes_of({}));
  EXPECT_EQ(replay({"true.acusrec"}).exit_code, 0);
  Claim claim;
  claim.false_hash = 1;
  write("false.acusrec", bytes_of(claim));
  for (const char* flag : {"--quiet", "--json"}) {
    const ProgramRun run = replay({"false.acusrec", flag});
    EXPECT_EQ(run.exit_code, 1);
    EXPECT_EQ(run.err.rfind("acus: false.acusrec: the replay differs: step 2 leaves another state, ", 0), 0U)
        << run.err;
    EXPECT_NE(run.err.find("step 1 was the last one found the same"), std::string::npos) << run.err;
    EXPECT_EQ(run.err.find("another program"), std::string::npos) << run.err;
  }
  claim.versions = R"({"acus": "0.0.1"})";
  write("old.acusrec", bytes_of(claim));
  const ProgramRun old = replay({"old.acusrec", "--quiet"});
  EXPECT_EQ(old.exit_code, 1);
  EXPECT_NE(old.err.find("the recording is of another program: acus was \"0.0.1\" and is "),
            std::string::npos)
      << old.err;
}

// As the run that was recorded, the replay says which step failed.
TEST_F(Replay, of_a_run_that_failed_fails_at_the_same_step) {
  Claim claim;
  claim.travels[2] = std::numeric_limits<double>::quiet_NaN();
  write("failed.acusrec", bytes_of(claim));
  const ProgramRun run = replay({"failed.acusrec"});
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_NE(run.err.find("the run failed at "), std::string::npos) << run.err;
  EXPECT_EQ(run.err.find("differs"), std::string::npos) << run.err;
  EXPECT_NE(run.out.find("The same bits: the 3 recorded states of 3 steps"), std::string::npos) << run.out;
  claim.travels = {1e-5, 1e300, 2e-5};
  claim.false_hash = 99;
  write("far.acusrec", bytes_of(claim));
  EXPECT_EQ(replay({"far.acusrec", "--quiet"}).exit_code, 1);
}

TEST_F(Replay, is_recorded_into_a_recording_and_nothing_else) {
  write("notes", "notes of the user\n");
  const ProgramRun run =
      run_program({"run", ACUS_SOURCE_DIR "/scenes/bare_column.toml", "--record", "notes"}, folder_);
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_NE(run.err.find("notes: is there already and is no recording"), std::string::npos) << run.err;
  EXPECT_EQ(file_text(folder_ + "/notes"), "notes of the user\n");
}

}  // namespace
}  // namespace acus::io
