#include "acus/study/runner.h"

#include <algorithm>
#include <atomic>
#include <filesystem>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

#include "acus/io/insertion.h"
#include "acus/io/run_folder.h"
#include "acus/sim/names.h"
#include "acus/study/markup.h"
#include "acus/study/run_record.h"

namespace acus::study {
namespace {

struct Job {
  std::string name, folder;
  const Run* run;
  double cost;  // of the whole run, in tetrahedra x steps
};

double cost_of(const Scene& scene) {
  constexpr double column_step = 100.0;  // tetrahedra: what a step costs that has none
  return io::step_count(scene) * (column_step + (scene.tissue.rigid ? 0.0 : scene.tissue.tetrahedra));
}

// What the workers share. Every member behind the mutex but the two atomics.
class Board {
 public:
  Board(std::vector<Job> jobs, long steps, const RunnerOptions& options)
      : jobs_(std::move(jobs)), options_(options), steps_(steps) {}

  void work();
  std::optional<Error> error() && { return std::move(error_); }

 private:
  std::optional<Error> run(const Job& job, std::string& outcome);
  io::Insertion insert(const Job& job, Simulation& simulation, io::RunFolder& folder, StageCamera& camera);
  bool stopped();
  void advance(long steps);
  void finish(const Job& job, const std::string& outcome);
  void fail(const Job& job, const Error& error);

  const std::vector<Job> jobs_;
  const RunnerOptions& options_;
  std::atomic<std::size_t> next_{0};
  std::atomic<bool> stop_{false};
  std::mutex mutex_;
  const long steps_;
  long steps_done_ = 0;
  std::optional<Error> error_;
};

void Board::advance(long steps) {
  const std::lock_guard lock(mutex_);
  steps_done_ += steps;
  if (options_.progress) options_.progress({steps_done_, steps_, {}, {}});
}

void Board::finish(const Job& job, const std::string& outcome) {
  const std::lock_guard lock(mutex_);
  if (options_.progress) options_.progress({steps_done_, steps_, job.name, outcome});
}

void Board::fail(const Job& job, const Error& error) {
  const std::lock_guard lock(mutex_);
  if (!error_) error_ = Error{joined({"run ", job.name, ": ", error.sentence})};
  stop_ = true;
}

bool Board::stopped() {
  if (!stop_ && options_.interrupted && options_.interrupted()) stop_ = true;
  return stop_;
}

std::optional<Error> Board::run(const Job& job, std::string& outcome) {
  const Scene& scene = job.run->scene;
  const std::string print = fingerprint(scene);
  if (options_.resume && is_finished(job.folder, print)) {
    outcome = "done before";
    advance(io::step_count(scene));
    return std::nullopt;
  }
  Result<Simulation> simulation = io::build_simulation(scene);
  if (!simulation) return simulation.error();
  mark_unfinished(job.folder);
  Result<io::RunFolder> folder = io::RunFolder::create(job.folder);
  if (!folder) return folder.error();
  StageCamera camera(*simulation);
  const io::Insertion insertion = insert(job, *simulation, *folder, camera);
  if (auto wrong = folder->finish(insertion)) return wrong;
  if (insertion.interrupted) return std::nullopt;
  outcome = name_of(acus::outcome(insertion.events));
  return mark_finished(job.folder, camera.snapshots(*simulation), print);
}

io::Insertion Board::insert(const Job& job, Simulation& simulation, io::RunFolder& folder,
                            StageCamera& camera) {
  constexpr int steps_between_signs = 100;
  int steps = 0, said = 0;
  const auto watch = [&](const Simulation& now) {
    if (!folder.record(now)) return false;
    camera.look(now);
    if (++steps - said >= steps_between_signs) advance(steps - std::exchange(said, steps));
    return !stopped();
  };
  io::Insertion insertion = io::run_insertion(simulation, watch);
  advance(io::step_count(job.run->scene) - said);
  return insertion;
}

void Board::work() {
  while (!stopped()) {
    const std::size_t mine = next_++;
    if (mine >= jobs_.size()) return;
    std::string outcome;
    if (const auto wrong = run(jobs_[mine], outcome)) {
      fail(jobs_[mine], *wrong);
    } else if (!stop_) {
      finish(jobs_[mine], outcome);
    }
  }
}

std::vector<Job> jobs_of(const Study& study, const std::string& folder) {
  std::vector<Job> jobs;
  for (const Group& group : study.groups) {
    for (const Run& run : group.runs)
      jobs.push_back({joined({group.name, "/", run.chosen.name}), run_folder(folder, group, run), &run,
                      cost_of(run.scene)});
  }
  // The longest first, so that no worker is left with a long one at the end; equal ones keep their order.
  std::stable_sort(jobs.begin(), jobs.end(), [](const Job& a, const Job& b) { return a.cost > b.cost; });
  return jobs;
}

}  // namespace

std::string run_folder(const std::string& folder, const Group& group, const Run& run) {
  return (std::filesystem::path(folder) / group.name / run.chosen.name).string();
}

long step_count(const Study& study) {
  long steps = 0;
  for (const Group& group : study.groups) {
    for (const Run& run : group.runs) steps += io::step_count(run.scene);
  }
  return steps;
}

std::optional<Error> do_runs(const Study& study, const RunnerOptions& options) {
  Board board(jobs_of(study, options.folder), step_count(study), options);
  std::vector<std::thread> workers;
  for (int i = 1; i < options.jobs; ++i) workers.emplace_back([&board] { board.work(); });
  board.work();
  for (std::thread& worker : workers) worker.join();
  return std::move(board).error();
}

}  // namespace acus::study
