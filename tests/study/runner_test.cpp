#include "acus/study/runner.h"

#include <gtest/gtest.h>

#include <mutex>
#include <new>
#include <set>
#include <stdexcept>
#include <thread>

#include "acus/study/run_record.h"
#include "study_files.h"

namespace acus::study {
namespace {

// Three columns in the testing machine, 199 steps each: no tissue, so next to nothing to do.
Study three_columns(const std::filesystem::path& folder) {
  const Result<Study> study = read_study(write_text(folder / "columns.toml", R"(
[scene.tissue]
rigid = true
[scene.hand]
speed_mm_s = 20.0
travel_mm = 3.98
[axes]
needle.length_mm = [150, 200, 300]
)"),
                                         {});
  EXPECT_TRUE(study) << study.error().sentence;
  return *study;
}

RunnerOptions into(const std::filesystem::path& folder, int jobs) {
  RunnerOptions options;
  options.folder = folder.string();
  options.jobs = jobs;
  return options;
}

TEST(Runner, an_exception_in_a_worker_is_the_failure_of_its_run) {
  const auto folder = fresh_folder();
  const Study study = three_columns(folder);
  for (int jobs : {1, 3}) {
    RunnerOptions options = into(folder, jobs);
    options.progress = [](const Progress&) { throw std::runtime_error("no more paper"); };
    const auto failure = do_runs(study, options);
    ASSERT_TRUE(failure);
    EXPECT_NE(failure->sentence.find("run columns/length_mm_"), std::string::npos) << failure->sentence;
    EXPECT_NE(failure->sentence.find("no more paper"), std::string::npos) << failure->sentence;
    EXPECT_FALSE(failure->wrong_input);
    options.progress = [](const Progress&) { throw std::bad_alloc(); };
    const auto short_of_memory = do_runs(study, options);
    ASSERT_TRUE(short_of_memory);
    EXPECT_NE(short_of_memory->sentence.find("memory"), std::string::npos) << short_of_memory->sentence;
  }
}

TEST(Runner, progress_never_goes_back_and_ends_at_the_number_of_steps) {
  const auto folder = fresh_folder();
  const Study study = three_columns(folder);
  ASSERT_EQ(step_count(study), 3 * 199);
  for (int jobs : {1, 2, 1000}) {
    long last = 0;
    RunnerOptions options = into(folder, jobs);
    options.progress = [&](const Progress& now) {
      EXPECT_GE(now.steps_done, last);
      EXPECT_LE(now.steps_done, now.steps);
      last = now.steps_done;
    };
    ASSERT_FALSE(do_runs(study, options));
    EXPECT_EQ(last, 3 * 199);
  }
}

TEST(Runner, no_more_threads_are_started_than_there_are_runs) {
  const auto folder = fresh_folder();
  const Study study = three_columns(folder);
  std::mutex mutex;
  std::set<std::thread::id> askers;
  RunnerOptions options = into(folder, 200);
  options.interrupted = [&] {
    const std::lock_guard lock(mutex);
    askers.insert(std::this_thread::get_id());
    return false;
  };
  ASSERT_FALSE(do_runs(study, options));
  EXPECT_LE(askers.size(), 3u);
}

// Euler's load is reached long before the 199 steps are over.
TEST(Runner, a_run_ends_with_the_event_that_the_study_names) {
  const auto folder = fresh_folder();
  Study study = three_columns(folder);
  const std::string to_the_end = fingerprint(study.groups[0].runs[0]);
  for (study::Run& run : study.groups[0].runs) run.until = "buckling";
  ASSERT_FALSE(do_runs(study, into(folder, 1)));
  for (const study::Run& run : study.groups[0].runs) {
    const Result<RunRecord> record = read_run(run_folder(folder.string(), study.groups[0], run), run);
    ASSERT_TRUE(record) << record.error().sentence;
    EXPECT_TRUE(completed(*record));
    ASSERT_NE(find_event(*record, "buckling"), nullptr);
    EXPECT_EQ(column(*record, "time_s").back(), find_event(*record, "buckling")->time);
    EXPECT_LT(summary_count(*record, "/steps"), 199);
  }
  EXPECT_NE(fingerprint(study.groups[0].runs[0]), to_the_end);  // so that it is not taken for done
}

TEST(Runner, a_scene_that_cannot_be_built_is_wrong_input) {
  const auto folder = fresh_folder();
  Study study = three_columns(folder);
  study.groups[0].runs[1].scene.tissue.rigid = false;
  study.groups[0].runs[1].scene.tissue.mesh = (folder / "none.msh").string();
  const auto failure = do_runs(study, into(folder, 1));
  ASSERT_TRUE(failure);
  EXPECT_TRUE(failure->wrong_input);
  EXPECT_NE(failure->sentence.find("none.msh"), std::string::npos) << failure->sentence;
}

}  // namespace
}  // namespace acus::study
