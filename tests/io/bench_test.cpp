// The bench's report. How fast it is, no test says.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "program.h"
#include "reference_step.h"

namespace acus::io {
namespace {

TEST(Bench, reports_every_part_and_solves_no_worse_than_its_reference) {
  const std::string folder = fresh_folder("bench");
  for (const std::vector<std::string>& more :
       {std::vector<std::string>{"--element", "linear"}, {"--equal", "change"}, {"--equal", "momentum"}}) {
    std::vector<std::string> words = {"bench", "--json", "--sizes", "1000", "--steps", "20"};
    words.insert(words.end(), more.begin(), more.end());
    const ProgramRun run = run_program(words, folder);
    ASSERT_EQ(run.exit_code, 0) << run.err;
    EXPECT_EQ(run.err, "");
    const nlohmann::json results = nlohmann::json::parse(run.out)["results"];
    ASSERT_EQ(results.size(), 1U);
    const nlohmann::json& row = results[0];
    for (const char* tetrahedra : {"tetrahedra", "reference_tetrahedra"})
      EXPECT_NEAR(row[tetrahedra].get<double>(), 1000.0, 100.0) << tetrahedra;
    for (const char* key : {"nodes", "reference_nodes", "iterations", "us_per_step", "mean_us_per_step",
                            "reference_us_per_step", "ratio", "real_time_factor"})
      EXPECT_GT(row[key].get<double>(), 0.0) << key;
    EXPECT_EQ(row["stages"].size(), 8U);
    for (const char* part :
         {"contact", "assembly", "rod", "coupling", "solve", "rotation", "cutting", "ledger"})
      EXPECT_GT(row["stages"][part].get<double>(), 0.0) << part;
    const std::string of = more[1] == "linear" ? "_of_load" : more[1] == "change" ? "_of_change" : "";
    EXPECT_LE(row["residual" + of].get<double>(), row["reference_residual" + of].get<double>());
    EXPECT_TRUE(row["equal_is_met"].get<bool>());
    for (const char* residual : {"residual", "residual_of_change", "residual_of_load"}) {
      const double median = row[std::string("median_") + residual].get<double>();
      EXPECT_GT(median, 0.0) << residual;
      EXPECT_LE(median, row[residual].get<double>()) << residual;
    }
  }
  std::filesystem::remove_all(folder);
}

// Another program, written apart from it, leaves 3.59e-8 at the 45th step from rest on 7 x 7 x 4 boxes,
// with FMA and without.
TEST(Bench, its_reference_leaves_what_another_program_leaves) {
  bench::ReferenceStep reference(1000);
  EXPECT_EQ(reference.tetrahedra(), 980);
  EXPECT_EQ(reference.nodes(), 320);
  for (int step = 1; step <= 45; ++step) reference.advance();
  EXPECT_NEAR(reference.residual().of_change, 3.59e-8, 0.02e-8);
}

// 11 boxes high: the top is not at 0.06 m to the last bit.
TEST(Bench, its_reference_bears_its_load_whatever_the_number_of_boxes) {
  bench::ReferenceStep reference(20000);
  reference.advance();
  EXPECT_GT(reference.residual().of_load, 0.0);
}

TEST(Bench, its_reference_is_run_from_rest_whatever_the_number_of_steps) {
  const std::string folder = fresh_folder("bench");
  std::vector<nlohmann::json> rows;
  for (const char* steps : {"1", "41"}) {
    const ProgramRun run = run_program({"bench", "--json", "--sizes", "1000", "--steps", steps}, folder);
    ASSERT_EQ(run.exit_code, 0) << run.err;
    rows.push_back(nlohmann::json::parse(run.out)["results"][0]);
  }
  for (const char* key : {"reference_tetrahedra", "reference_nodes", "reference_residual",
                          "reference_residual_of_change", "reference_residual_of_load"})
    EXPECT_EQ(rows[0][key], rows[1][key]) << key;
  std::filesystem::remove_all(folder);
}

TEST(Bench, follows_a_whole_insertion_in_and_out_again) {
  const std::string folder = fresh_folder("bench");
  const ProgramRun run = run_program(
      {"bench", "--insertion", "--json", "--sizes", "1000", "--element", "linear", "--set",
       "run.solver_tolerance=1e-3", "--set", "hand.speed_mm_s=100", "--set", "contact.rupture_force_N=0.2"},
      folder);
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(run.err, "");
  const nlohmann::json results = nlohmann::json::parse(run.out)["results"];
  ASSERT_EQ(results.size(), 1U);
  const nlohmann::json& insertion = results[0]["insertion"];
  EXPECT_EQ(insertion["solver_tolerance"], 1e-3);
  EXPECT_EQ(insertion["time_step_ms"], 1.0);
  EXPECT_EQ(insertion["steps"], 1000);  // 5 mm above the tissue to 45 mm inside and back
  EXPECT_NEAR(insertion["simulated_s"].get<double>(), 1.0, 1e-9);
  for (const char* clock : {"processor_us", "wall_us"}) {
    const nlohmann::json& us = insertion[clock];
    EXPECT_GT(us["mean"].get<double>(), 0.0) << clock;
    EXPECT_LE(us["median"], us["p99"]) << clock;
    EXPECT_LE(us["p99"], us["p99_9"]) << clock;
    EXPECT_LE(us["p99_9"], us["worst"]) << clock;
  }
  EXPECT_LT(insertion["spare_at_median"].get<double>(), 1.0);
  for (const char* key : {"real_time_factor", "build_s", "insertions_a_minute_a_core"})
    EXPECT_GT(insertion[key].get<double>(), 0.0) << key;
  int steps = 0;
  for (const auto& stage : insertion["by_stage_us"]) steps += stage["steps"].get<int>();
  EXPECT_EQ(steps, 1000);
  for (const char* stage : {"free", "inserted", "withdrawn"})
    EXPECT_TRUE(insertion["by_stage_us"].contains(stage)) << stage;
  std::vector<std::string> events;
  for (const auto& event : insertion["events"]) events.push_back(event["event"]);
  for (const char* event : {"contact", "puncture"})
    EXPECT_NE(std::find(events.begin(), events.end(), event), events.end()) << event;
  std::filesystem::remove_all(folder);
}

struct Refused {
  std::vector<std::string> words;
  std::string sentence;
};

TEST(Bench, refuses_what_it_cannot_measure_in_one_sentence) {
  const std::string folder = fresh_folder("bench");
  for (const Refused& wrong :
       {Refused{{"--sizes", "3"}, "--sizes"},
        {{"--sizes", "many"}, "--sizes"},
        {{"--sizes", "1000,,-7"}, "--sizes"},
        {{"--steps", "1.5"}, "--steps"},
        {{"--steps", "0"}, "--steps"},
        {{"--element", "cubic"}, "--element: cubic not in {linear,nodal_pressure}"},
        {{"--frobnicate"}, "--frobnicate"},
        {{"--equal", "force"}, "--equal: force not in {load,change,momentum}"},
        {{"--set", "run.solver_tolerance=1e-3"}, "add --insertion"},
        {{"--insertion", "--steps", "3"}, "--steps is for single steps"},
        {{"--insertion", "--equal", "load"}, "run.solver_tolerance"},
        {{"--insertion", "--set", "tissue.tetrahedra=2000"}, "--sizes"},
        {{"--insertion", "--set", "tissue.mesh=liver.msh"}, "tissue.mesh"},
        {{"--insertion", "--set", "run.solver_tolerence=1"}, "did you mean run.solver_tolerance?"},
        {{"--insertion", "--set", "run.solver_tolerance=nan"}, "run.solver_tolerance"}}) {
    std::vector<std::string> words = {"bench"};
    words.insert(words.end(), wrong.words.begin(), wrong.words.end());
    const ProgramRun run = run_program(words, folder);
    EXPECT_EQ(run.exit_code, 2) << wrong.sentence;
    EXPECT_EQ(run.out, "");
    EXPECT_NE(run.err.find(wrong.sentence), std::string::npos) << run.err;
  }
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace acus::io
