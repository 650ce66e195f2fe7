// The built program: what it writes, and that nothing depends on how often it was killed or how many workers
// it had.
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <map>
#include <pugixml.hpp>
#include <regex>
#include <thread>

#include "study_files.h"

namespace acus::study {
namespace {

namespace fs = std::filesystem;

pid_t start(const std::vector<std::string>& words, const fs::path& said,
            std::string program = ACUS_BUILD_DIR "/acus") {
  const pid_t child = fork();
  if (child != 0) return child;
  if (std::freopen(said.c_str(), "w", stderr) == nullptr || std::freopen("/dev/null", "w", stdout) == nullptr)
    _exit(126);
  std::vector<char*> argv;
  argv.push_back(program.data());
  std::vector<std::string> copies = words;
  for (std::string& word : copies) argv.push_back(word.data());
  argv.push_back(nullptr);
  execv(program.c_str(), argv.data());
  _exit(127);
}

int exit_code_of(pid_t child) {
  int status = 0;
  waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

struct Outcome {
  int exit_code;
  std::string said;
};
Outcome acus_study(std::vector<std::string> words, const fs::path& folder) {
  words.insert(words.begin(), "study");
  const int code = exit_code_of(start(words, folder / "said"));
  return {code, text_of(folder / "said")};
}

// Four needles pushed into a coarse block by coarse steps: a tenth of a second each.
std::string small_study(const fs::path& folder) {
  return write_text(folder / "small.toml", R"(
title = "Small & <quick>"
[scene.tissue]
tetrahedra = 600
[scene.hand]
speed_mm_s = 40.0
travel_mm = 24.0
[scene.run]
time_step_ms = 4.0
[axes]
needle.support = ["pinned_pinned", "clamped_pinned"]
needle.length_mm = [120, 200]
[report]
show = ["force", "energy", "stages", "mesh", "loads"]
panel = "needle.support"
curve = "needle.length_mm"
)");
}

// Two columns in the testing machine, without tissue: next to no work.
std::string column_study(const fs::path& folder) {
  return write_text(folder / "columns.toml", R"(
[scene.tissue]
rigid = true
[scene.hand]
travel_mm = 5.0
[axes]
needle.length_mm = [150, 200]
)");
}

const char* const run_names[] = {"pinned_pinned-length_mm_120", "pinned_pinned-length_mm_200",
                                 "clamped_pinned-length_mm_120", "clamped_pinned-length_mm_200"};

TEST(StudyProgram, results_do_not_depend_on_the_number_of_workers) {
  const fs::path folder = fresh_folder();
  const std::string study = small_study(folder);
  ASSERT_EQ(acus_study({study, "--jobs", "1", "--out", (folder / "one").string()}, folder).exit_code, 0);
  ASSERT_EQ(acus_study({study, "--jobs", "3", "--out", (folder / "three").string()}, folder).exit_code, 0);
  const std::string one = text_of(folder / "one" / "results.csv");
  EXPECT_EQ(std::count(one.begin(), one.end(), '\n'), 5);
  EXPECT_EQ(one, text_of(folder / "three" / "results.csv"));
  EXPECT_EQ(text_of(folder / "one" / "report.html"), text_of(folder / "three" / "report.html"));
  for (const char* run : run_names)
    EXPECT_EQ(text_of(folder / "one/small" / run / "trace.csv"),
              text_of(folder / "three/small" / run / "trace.csv"));
}

TEST(StudyProgram, a_killed_study_resumes_to_the_same_bytes) {
  const fs::path folder = fresh_folder();
  const std::string study = small_study(folder);
  const fs::path whole = folder / "whole", killed = folder / "killed";
  ASSERT_EQ(acus_study({study, "--jobs", "1", "--out", whole.string()}, folder).exit_code, 0);
  const pid_t child = start({"study", study, "--jobs", "1", "--out", killed.string()}, folder / "said");
  // Killed as soon as one run is done: the next is then in the middle.
  const auto any_finished = [&] {
    for (const char* run : run_names) {
      if (fs::exists(killed / "small" / run / "finished")) return true;
    }
    return false;
  };
  // One that ended by itself is waited for once only: its number may belong to another process by then.
  bool ended = false;
  while (!any_finished() && !ended) {
    ended = waitpid(child, nullptr, WNOHANG) != 0;
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  ASSERT_FALSE(ended) << text_of(folder / "said");
  kill(child, SIGKILL);
  waitpid(child, nullptr, 0);
  ASSERT_FALSE(fs::exists(killed / "results.csv"));
  const Outcome resumed = acus_study({study, "--jobs", "2", "--resume", "--out", killed.string()}, folder);
  ASSERT_EQ(resumed.exit_code, 0) << resumed.said;
  EXPECT_NE(resumed.said.find("done before"), std::string::npos) << resumed.said;
  EXPECT_EQ(text_of(whole / "results.csv"), text_of(killed / "results.csv"));
  EXPECT_EQ(text_of(whole / "report.html"), text_of(killed / "report.html"));
}

TEST(StudyProgram, resuming_does_a_run_again_whose_scene_has_changed) {
  const fs::path folder = fresh_folder(), out = folder / "out";
  const std::string study = small_study(folder);
  ASSERT_EQ(acus_study({study, "--out", out.string()}, folder).exit_code, 0);
  const Outcome changed =
      acus_study({study, "--resume", "--set", "contact.rupture_force_N=0.2", "--out", out.string()}, folder);
  EXPECT_EQ(changed.exit_code, 0);
  EXPECT_EQ(changed.said.find("done before"), std::string::npos) << changed.said;
}

TEST(StudyProgram, resuming_with_a_program_that_was_built_again_does_every_run_again) {
  const fs::path folder = fresh_folder(), out = folder / "out", rebuilt = folder / "acus";
  const std::string study = column_study(folder);
  const std::vector<std::string> words{"study", study, "--resume", "--out", out.string()};
  fs::copy_file(ACUS_BUILD_DIR "/acus", rebuilt);
  const auto said = [&] {
    EXPECT_EQ(exit_code_of(start(words, folder / "said", rebuilt)), 0);
    return text_of(folder / "said");
  };
  EXPECT_EQ(said().find("done before"), std::string::npos);
  EXPECT_NE(said().find("done before"), std::string::npos);
  std::ofstream(rebuilt, std::ios::binary | std::ios::app) << "other bytes";
  EXPECT_EQ(said().find("done before"), std::string::npos);
}

TEST(StudyProgram, the_report_is_whole_and_needs_nothing_from_outside) {
  const fs::path folder = fresh_folder(), out = folder / "out";
  ASSERT_EQ(acus_study({small_study(folder), "--out", out.string()}, folder).exit_code, 0);
  const std::string html = text_of(out / "report.html");
  EXPECT_LT(html.size(), 2u << 20);
  for (const char* run : run_names) EXPECT_NE(html.find(run), std::string::npos) << run;
  for (const char* word : {"http:", "https:", "url(", "@import", "<script", "<link", "src="})
    EXPECT_EQ(html.find(word), std::string::npos) << word;
  EXPECT_NE(html.find("Small &amp; &lt;quick&gt;"), std::string::npos);
  int pictures = 0;
  for (const auto& file : fs::directory_iterator(out / "figures")) {
    pugi::xml_document xml;
    EXPECT_TRUE(xml.load_file(file.path().c_str())) << file.path();
    EXPECT_GT(std::string(xml.child("svg").attribute("aria-label").value()).size(), 20u) << file.path();
    ++pictures;
  }
  EXPECT_EQ(pictures, 7);  // force, energy and stages for each support; one mesh
}

TEST(StudyProgram, a_failed_run_is_left_out_of_the_report_of_the_others) {
  const fs::path folder = fresh_folder(), out = folder / "out";
  const std::string study = write_text(folder / "columns.toml", R"(
[scene.needle]
model = "column"
[scene.tissue]
rigid = true
[scene.hand]
speed_mm_s = 100.0
[[run]]
name = "bent"
hand.travel_mm = 20.0
[[run]]
name = "folded"
hand.travel_mm = 190.0
[report]
show = ["force", "energy", "column", "loads"]
)");
  const Outcome outcome = acus_study({study, "--out", out.string()}, folder);
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_NE(outcome.said.find("run columns/folded ended early: needle_folded"), std::string::npos)
      << outcome.said;
  const std::string html = text_of(out / "report.html");
  EXPECT_NE(html.find("Left out here, because they ended early: folded (needle-folded)."), std::string::npos);
  EXPECT_TRUE(fs::exists(out / "figures" / "columns-force.svg"));
}

TEST(StudyProgram, a_study_over_movements_of_the_hand_has_its_report) {
  const fs::path folder = fresh_folder(), out = folder / "out";
  const std::string study = write_text(folder / "hands.toml", R"(
[scene.tissue]
tetrahedra = 600
[scene.hand]
kind = "path"
path = [[0, 0], [1, 1]]
[axes]
hand.path = [[[0, 0], [0.2, 5]], [[0, 0], [0.2, 5], [0.3, 5], [0.5, 0]]]
[report]
show = ["force", "energy", "stages", "mesh", "loads", "convergence", "coupling", "felt", "map", "track"]
panel = "hand.path"
)");
  const Outcome outcome = acus_study({study, "--out", out.string()}, folder);
  EXPECT_EQ(outcome.exit_code, 0) << outcome.said;
  const std::string html = text_of(out / "report.html");
  EXPECT_NE(html.find("time, s"), std::string::npos);
  EXPECT_NE(html.find("travel, mm"), std::string::npos);
  EXPECT_NE(html.find("since the hand goes back"), std::string::npos);
}

// Against the most exact run, which has no deviation from itself; a rough one has some.
TEST(StudyProgram, what_the_solver_leaves_is_told_for_each_tolerance_and_precision) {
  const fs::path folder = fresh_folder(), out = folder / "out";
  const std::string study = write_text(folder / "rough.toml", R"(
[scene.tissue]
tetrahedra = 600
[scene.needle]
model = "column"
[scene.hand]
travel_mm = 2
speed_mm_s = 50
[axes]
run.solver_precision = ["single", "double"]
run.solver_tolerance = [1e-9, 1e-2]
[report]
show = ["exactness"]
)");
  const Outcome outcome = acus_study({study, "--out", out.string()}, folder);
  EXPECT_EQ(outcome.exit_code, 0) << outcome.said;
  const std::string html = text_of(out / "report.html");
  const std::regex row("<td[^>]*>(1e-09|0.01)</td><td[^>]*>(single|double)</td><td[^>]*>([^<]*)</td>");
  std::map<std::string, std::string> deviation;
  for (auto at = std::sregex_iterator(html.begin(), html.end(), row); at != std::sregex_iterator(); ++at)
    deviation[(*at)[1].str() + (*at)[2].str()] = (*at)[3].str();
  ASSERT_EQ(deviation.size(), 4U);
  EXPECT_EQ(deviation["1e-09double"], "");
  EXPECT_LT(std::stod(deviation["1e-09single"]), 1e-7);
  EXPECT_GT(std::stod(deviation["0.01single"]), 1e-6);
  EXPECT_GT(std::stod(deviation["0.01double"]), 1e-6);
}

// Two boxes of gmsh, 10 by 10 by 15 mm, in a folder that is not where the program runs.
TEST(StudyProgram, a_mesh_file_is_found_beside_its_study) {
  const fs::path folder = fresh_folder(), out = folder / "out";
  fs::copy_file(fs::path(ACUS_SOURCE_DIR) / "tests/fixtures/meshes/gmsh_22.msh", folder / "o'neil.msh");
  const std::string study = write_text(folder / "organ.toml", R"(
[scene.tissue]
mesh = "o'neil.msh"
target_mm = [5.0, 5.0, 5.0]
[scene.hand]
travel_mm = 0.5
[axes]
needle.radius_mm = [0.3, 0.4]
[report]
show = ["force", "stages", "mesh"]
)");
  const Outcome outcome = acus_study({study, "--out", out.string()}, folder);
  EXPECT_EQ(outcome.exit_code, 0) << outcome.said;
  EXPECT_TRUE(fs::exists(out / "figures" / "organ-mesh.svg"));
}

TEST(StudyProgram, bad_input_is_exit_code_two) {
  const fs::path folder = fresh_folder();
  const std::string wrong = write_text(folder / "wrong.toml", "[axes]\nneedle.length_mm = [-1]\n");
  const Outcome outcome = acus_study({wrong, "--out", (folder / "out").string()}, folder);
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_NE(outcome.said.find("wrong.toml:2:21: needle.length_mm must be"), std::string::npos)
      << outcome.said;
  EXPECT_FALSE(fs::exists(folder / "out"));
  EXPECT_EQ(acus_study({(folder / "none.toml").string()}, folder).exit_code, 2);
  EXPECT_EQ(acus_study({small_study(folder), "--jobs", "0"}, folder).exit_code, 2);
  EXPECT_EQ(
      acus_study({small_study(folder), "--out", (folder / "wrong.toml" / "sub").string()}, folder).exit_code,
      2);
  // Longer than any name of a file may be.
  const Outcome endless = acus_study({std::string(5000, 'a')}, folder);
  EXPECT_EQ(endless.exit_code, 2);
  EXPECT_EQ(std::count(endless.said.begin(), endless.said.end(), '\n'), 1);
}

TEST(StudyProgram, a_full_disk_in_the_middle_is_exit_code_one) {
  ASSERT_TRUE(fs::exists("/dev/full"));
  const fs::path folder = fresh_folder(), out = folder / "out";
  const std::string study = column_study(folder);
  for (const char* file :
       {"columns/length_mm_200/trace.csv", "columns/length_mm_200/snapshots.json.part", "results.csv.part"}) {
    fs::remove_all(out);
    fs::create_directories((out / file).parent_path());
    fs::create_symlink("/dev/full", out / file);
    const Outcome outcome = acus_study({study, "--quiet", "--out", out.string()}, folder);
    EXPECT_EQ(outcome.exit_code, 1) << file;
    EXPECT_NE(outcome.said.find("the disk is full"), std::string::npos) << outcome.said;
  }
}

}  // namespace
}  // namespace acus::study
