// acus study: a table of insertions, and a report of it.
#include "acus/study/study.h"

#include <cstdio>
#include <filesystem>
#include <system_error>
#include <thread>

#include "acus/io/output_file.h"
#include "acus/study/markup.h"
#include "acus/study/report.h"
#include "acus/study/runner.h"
#include "interruption.h"
#include "progress.h"
#include "verbs.h"

namespace acus::app {
namespace {

namespace fs = std::filesystem;
using study::joined;

// A name without a folder or ending, which is no file here, is one of the studies that come with acus.
std::string study_file(const std::string& given) {
  std::error_code unknown;  // what is no possible name of a file is no file
  if (fs::exists(given, unknown) || given.find('/') != std::string::npos || given.ends_with(".toml"))
    return given;
  const fs::path shipped = fs::path(ACUS_STUDIES) / (given + ".toml");
  return fs::exists(shipped, unknown) ? shipped.string() : given;
}

std::optional<study::Failure> do_all_runs(const study::Study& study, const StudyOptions& options,
                                          const std::string& out) {
  Progress progress("step", study::step_count(study), options.quiet);
  study::RunnerOptions runner;
  runner.folder = out;
  runner.jobs =
      options.jobs > 0 ? options.jobs : static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  runner.resume = options.resume;
  runner.interrupted = [] { return interrupted(); };
  runner.progress = [&](const study::Progress& now) {
    if (!now.run.empty() && !options.quiet) progress.say(joined({now.run, ": ", now.outcome}));
    progress.update(now.steps_done);
  };
  return study::do_runs(study, runner);
}

Result<std::vector<study::GroupRecords>> read_all(const study::Study& study, const std::string& out) {
  std::vector<study::GroupRecords> groups;
  for (const study::Group& group : study.groups) {
    study::GroupRecords records{&group, {}};
    for (const study::Run& run : group.runs) {
      Result<study::RunRecord> record = study::read_run(study::run_folder(out, group, run), run);
      if (!record) return record.error();
      records.runs.push_back(std::move(*record));
    }
    groups.push_back(std::move(records));
  }
  return groups;
}

std::optional<Error> write_pictures(const study::Report& report, const fs::path& folder) {
  if (auto wrong = io::make_folder(folder.string())) return wrong;
  for (const study::PictureFile& picture : report.pictures) {
    if (auto wrong = io::write_file((folder / picture.name).string(), picture.svg)) return wrong;
  }
  return std::nullopt;
}

std::optional<Error> write_results(const study::Study& study, const std::vector<study::GroupRecords>& groups,
                                   const StudyOptions& options, const fs::path& out) {
  if (auto wrong = io::write_file((out / "results.csv").string(), study::results_csv(groups))) return wrong;
  const study::Report report = study::build_report(study, groups);
  if (auto wrong = io::write_file((out / "report.html").string(), report.html)) return wrong;
  return write_pictures(report, options.figures.empty() ? out / "figures" : fs::path(options.figures));
}

int failed_runs(const std::vector<study::GroupRecords>& groups) {
  int failed = 0;
  for (const study::GroupRecords& group : groups) {
    for (const study::RunRecord& run : group.runs) {
      if (study::completed(run)) continue;
      ++failed;
      refused(joined({"run ", group.group->name, "/", run.chosen.name,
                      " ended early: ", study::summary_text(run, "/health")}),
              run_failed);
    }
  }
  return failed;
}

}  // namespace

int do_study(const StudyOptions& options) {
  const Result<study::Study> study = study::read_study(study_file(options.study), options.settings);
  if (!study) return refused(study.error().sentence, bad_input);
  const std::string out = options.out.empty() ? (fs::path("out") / study->name).string() : options.out;
  if (const auto wrong = io::make_folder(out)) return refused(wrong->sentence, bad_input);
  catch_interruptions();
  if (const auto wrong = do_all_runs(*study, options, out))
    return refused(wrong->sentence, wrong->wrong_input ? bad_input : run_failed);
  if (interrupted())
    return refused("interrupted; the same command with --resume goes on from here", run_failed);
  const Result<std::vector<study::GroupRecords>> groups = read_all(*study, out);
  if (!groups) return refused(groups.error().sentence, run_failed);
  if (const auto wrong = write_results(*study, *groups, options, out))
    return refused(wrong->sentence, run_failed);
  if (!options.quiet)
    std::printf("%s\n%s\n", (fs::path(out) / "results.csv").c_str(), (fs::path(out) / "report.html").c_str());
  return failed_runs(*groups) == 0 ? done : run_failed;
}

}  // namespace acus::app
