// What a user of the built program relies on.
#include "program.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

namespace acus::io {
namespace {

using nlohmann::json;

const std::vector<std::string> column = {"run", ACUS_SOURCE_DIR "/scenes/bare_column.toml"};

std::vector<std::string> with(std::vector<std::string> words, const std::vector<std::string>& more) {
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

long lines(const std::string& text) { return std::count(text.begin(), text.end(), '\n'); }

TEST(Program, says_its_version_and_helps) {
  const std::string folder = fresh_folder("version");
  EXPECT_EQ(run_program({"--version"}, folder).out.find("acus "), 0U);
  for (const std::vector<std::string>& words :
       {std::vector<std::string>{"--help"}, {"run", "--help"}, {"check", "--help"}}) {
    const ProgramRun run = run_program(words, folder);
    EXPECT_EQ(run.exit_code, 0);
    EXPECT_NE(run.out.find("--help"), std::string::npos);
    EXPECT_EQ(run.err, "");
  }
  std::filesystem::remove_all(folder);
}

// Euler's load of the clamped-pinned needle of Table I is 0.6422 N; its elastica at 30 % shortening
// carries 1.1103 of it.
TEST(Program, json_holds_the_scene_as_run_and_eulers_load) {
  const std::string folder = fresh_folder("json");
  const ProgramRun run = run_program(with(column, {"--json", "--set", "run.trace_stride=7"}), folder);
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(run.err, "");
  const json summary = json::parse(run.out);
  EXPECT_EQ(summary["outcome"], "never_punctured");
  EXPECT_EQ(summary["completed"], true);
  EXPECT_EQ(summary["scene"]["run"]["trace_stride"], 7);
  EXPECT_EQ(summary["scene"]["needle"]["youngs_modulus_GPa"], 200.0);
  EXPECT_EQ(summary["scene"]["tissue"]["rigid"], true);
  ASSERT_EQ(summary["bucklings"].size(), 1U);
  EXPECT_NEAR(summary["bucklings"][0]["hand_force_N"].get<double>(), 0.6422, 0.005 * 0.6422);
  EXPECT_NEAR(summary["bucklings"][0]["predicted_load_N"].get<double>(), 0.6422, 1e-4);
  EXPECT_NEAR(summary["peak_hand_force_N"].get<double>(), 1.1103 * 0.6422, 0.01 * 0.713);
  EXPECT_LT(summary["energy"]["relative_residual"].get<double>(), 0.01);
  EXPECT_EQ(summary["state_hash"].get<std::string>().size(), 16U);
  for (const char* key : {"acus", "compiler", "build_type", "eigen"})
    EXPECT_FALSE(summary["versions"][key].get<std::string>().empty());
  std::filesystem::remove_all(folder);
}

TEST(Program, same_scene_gives_the_same_bits) {
  const std::string folder = fresh_folder("bits");
  const auto words = with(column, {"--json", "--set", "tissue.rigid=false", "--set", "tissue.tetrahedra=300",
                                   "--set", "hand.travel_mm=4"});
  const auto hash = [&] { return json::parse(run_program(words, folder).out)["state_hash"]; };
  EXPECT_EQ(hash(), hash());
  std::filesystem::remove_all(folder);
}

TEST(Program, folder_holds_trace_events_summary_and_drawings) {
  const std::string folder = fresh_folder("folder");
  const ProgramRun run =
      run_program(with(column, {"--set", "tissue.rigid=false", "--set", "tissue.tetrahedra=300", "--set",
                                "hand.travel_mm=4", "--set", "run.trace_stride=3", "--out", "deep/down",
                                "--vtu-every", "100", "--quiet"}),
                  folder);
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(run.out + run.err, "");
  const std::string out = folder + "/deep/down/", trace = file_text(out + "trace.csv");
  EXPECT_EQ(lines(trace), 1 + 67 + 1);  // header; steps 0, 3 .. 198 of 200; the last step
  EXPECT_EQ(trace.find("time_s,hand_travel_m,hand_force_N"), 0U);
  EXPECT_EQ(file_text(out + "events.csv").find("time_s,event,hand_travel_m,hand_force_N,free_length_m\n"),
            0U);
  EXPECT_EQ(json::parse(file_text(out + "summary.json"))["steps"], 200);
  EXPECT_EQ(lines(file_text(out + "frames.pvd")), 5 + 2 * 3);
  for (const char* name : {"tissue_000000.vtu", "tissue_000002.vtu", "needle_000001.vtp"})
    EXPECT_TRUE(std::filesystem::exists(out + "frames/" + name)) << name;
  std::filesystem::remove_all(folder);
}

TEST(Program, scene_in_the_summary_runs_to_the_same_state) {
  const std::string folder = fresh_folder("again");
  const json first =
      json::parse(run_program(with(column, {"--json", "--set", "needle.length_mm=171.3"}), folder).out);
  std::ofstream again(folder + "/again.toml");
  for (const auto& [table, keys] : first["scene"].items())
    for (const auto& [key, value] : keys.items()) again << table << "." << key << " = " << value << "\n";
  again.close();
  const json second = json::parse(run_program({"run", "again.toml", "--json"}, folder).out);
  EXPECT_EQ(first["state_hash"], second["state_hash"]);
  EXPECT_EQ(first["scene"], second["scene"]);
  std::filesystem::remove_all(folder);
}

// /dev/full is a disk that is full; the summary is written beside its place first.
TEST(Program, a_full_disk_is_told) {
  const std::string folder = fresh_folder("full");
  for (const char* name : {"trace.csv", "events.csv", "summary.json.part"}) {
    const std::string out = folder + "/" + name + ".out";
    std::filesystem::create_directories(out);
    std::filesystem::create_symlink("/dev/full", out + "/" + name);
    const ProgramRun run = run_program(with(column, {"--out", out}), folder);
    EXPECT_EQ(run.exit_code, 1) << name;
    EXPECT_NE(run.err.find(std::string(name) + ": cannot be written to its end: the disk is full"),
              std::string::npos)
        << run.err;
    EXPECT_EQ(run.out, "") << name;
  }
  std::filesystem::remove_all(folder);
}

TEST(Program, a_full_standard_output_is_told_by_every_verb) {
  const std::string folder = fresh_folder("full_output");
  for (const std::string& words :
       {"run " + column[1] + " --json", std::string("check --keys"), "check " + column[1],
        std::string("bench --sizes 1000 --steps 1 --json")}) {
    const std::string command =
        "cd " + folder + " && " ACUS_BUILD_DIR "/acus " + words + " > /dev/full 2> stderr.txt";
    EXPECT_EQ(WEXITSTATUS(std::system(command.c_str())), 1) << words;
    EXPECT_NE(file_text(folder + "/stderr.txt").find("standard output cannot be written"), std::string::npos)
        << words;
  }
  std::filesystem::remove_all(folder);
}

// Else a run that is killed would leave its trace beside the summary and the frames of another one.
TEST(Program, a_run_into_the_folder_of_another_begins_by_removing_what_that_left) {
  const std::string folder = fresh_folder("twice"), out = folder + "/out";
  const auto run_into = [&](const std::vector<std::string>& more) {
    return run_program(with(with(column, {"--out", out, "--quiet"}), more), folder).exit_code;
  };
  ASSERT_EQ(run_into({"--vtu-every", "100"}), 0);
  ASSERT_TRUE(std::filesystem::exists(out + "/frames.pvd"));
  ASSERT_FALSE(std::filesystem::is_empty(out + "/frames"));
  std::ofstream(out + "/notes.txt") << "of the user\n";
  ASSERT_EQ(run_into({}), 0);
  EXPECT_FALSE(std::filesystem::exists(out + "/frames.pvd"));
  EXPECT_TRUE(std::filesystem::is_empty(out + "/frames"));
  EXPECT_TRUE(std::filesystem::exists(out + "/notes.txt"));
  EXPECT_TRUE(std::filesystem::exists(out + "/summary.json"));
  std::filesystem::remove_all(folder);
}

// An interruption ends the run at a step: every row is whole, and the summary says that the run is not.
TEST(Program, interruption_leaves_whole_files) {
  const std::string folder = fresh_folder("interrupted"), out = folder + "/out";
  std::ofstream(folder + "/interrupt.sh")
      << "\"$1\" run \"$2\" --set hand.speed_mm_s=0.01 --out out --quiet & pid=$!\n"
         "until [ -s out/trace.csv ]; do sleep 0.05; done\n"
         "kill -INT $pid; wait $pid\n";
  const std::string command = "cd " + folder + " && timeout 120 sh interrupt.sh " ACUS_BUILD_DIR "/acus " +
                              column[1] + " 2> stderr.txt";
  const int status = std::system(command.c_str());
  EXPECT_EQ(WEXITSTATUS(status), 1);
  EXPECT_NE(file_text(folder + "/stderr.txt").find("interrupted at"), std::string::npos)
      << file_text(folder + "/stderr.txt");
  const json summary = json::parse(file_text(out + "/summary.json"));
  EXPECT_EQ(summary["completed"], false);
  const std::string trace = file_text(out + "/trace.csv");
  EXPECT_EQ(lines(trace), 2 + summary["steps"].get<long>());
  std::istringstream rows(trace);
  const auto commas = [](const std::string& row) { return std::count(row.begin(), row.end(), ','); };
  std::string row;
  std::getline(rows, row);
  const auto columns = commas(row);
  while (std::getline(rows, row)) ASSERT_EQ(commas(row), columns) << row;
  std::filesystem::remove_all(folder);
}

TEST(Program, check_says_when_the_first_steps_fail) {
  const std::string folder = fresh_folder("check_fails");
  const auto check = run_program({"check", ACUS_SOURCE_DIR "/scenes/quick.toml", "--set",
                                  "contact.near_field=false", "--set", "contact.stiffness_N_m=1e9"},
                                 folder);
  EXPECT_EQ(check.exit_code, 1);
  EXPECT_NE(check.err.find("its first steps fail, at"), std::string::npos) << check.err;
  EXPECT_EQ(check.out.find("Cost"), std::string::npos) << check.out;
  std::filesystem::remove_all(folder);
}

TEST(Program, check_explains_every_shipped_scene) {
  const std::string folder = fresh_folder("check");
  int scenes = 0;
  for (const auto& entry : std::filesystem::directory_iterator(ACUS_SOURCE_DIR "/scenes")) {
    if (entry.path().extension() != ".toml") continue;
    ++scenes;
    const ProgramRun run =
        run_program({"check", entry.path().string(), "--set", "tissue.tetrahedra=400"}, folder);
    EXPECT_EQ(run.exit_code, 0) << run.err;
    for (const char* part : {"makes sense", "Needle", "Tissue", "Expect", "Buckles", "Cost"})
      EXPECT_NE(run.out.find(part), std::string::npos) << entry.path() << run.out;
  }
  EXPECT_GE(scenes, 5);
  std::filesystem::remove_all(folder);
}

TEST(Program, keys_are_listed_as_in_the_shipped_page) {
  const std::string folder = fresh_folder("keys");
  EXPECT_EQ(run_program({"check", "--keys"}, folder).out, file_text(ACUS_SOURCE_DIR "/docs/scene-keys.md"));
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace acus::io
