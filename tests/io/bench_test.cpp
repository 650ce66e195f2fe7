// The bench's report. How fast it is, no test says.
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "program.h"

namespace acus::io {
namespace {

TEST(Bench, reports_every_part_and_solves_no_worse_than_its_reference) {
  const std::string folder = fresh_folder("bench");
  const ProgramRun run = run_program({"bench", "--json", "--sizes", "1000", "--steps", "20"}, folder);
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(run.err, "");
  const nlohmann::json results = nlohmann::json::parse(run.out)["results"];
  ASSERT_EQ(results.size(), 1U);
  const nlohmann::json& row = results[0];
  EXPECT_NEAR(row["tetrahedra"].get<double>(), 1000.0, 100.0);
  for (const char* key :
       {"nodes", "iterations", "us_per_step", "reference_us_per_step", "ratio", "real_time_factor"})
    EXPECT_GT(row[key].get<double>(), 0.0) << key;
  for (const char* part : {"touch", "assembly", "solve", "rotation", "cutting", "ledger"})
    EXPECT_GT(row["stages"][part].get<double>(), 0.0) << part;
  EXPECT_GT(row["residual"].get<double>(), 0.0);
  EXPECT_LE(row["residual"].get<double>(), row["reference_residual"].get<double>());
  std::filesystem::remove_all(folder);
}

TEST(Bench, refuses_sizes_it_cannot_build) {
  const std::string folder = fresh_folder("bench");
  for (const char* sizes : {"3", "many", "1000,,-7"}) {
    const ProgramRun run = run_program({"bench", "--sizes", sizes}, folder);
    EXPECT_EQ(run.exit_code, 2) << sizes;
    EXPECT_NE(run.err.find("--sizes"), std::string::npos) << run.err;
  }
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace acus::io
