#include "acus/study/runner.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <filesystem>
#include <mutex>
#include <new>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

#include "acus/io/insertion.h"
#include "acus/io/run_folder.h"
#include "acus/sim/hand.h"
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

bool has_happened(const std::string& event, const Simulation& simulation) {
  const auto events = simulation.events();
  return std::any_of(events.begin(), events.end(),
                     [&](const Event& one) { return name_of(one.kind) == event; });
}

// What the workers share. Every member behind the mutex but the two atomics.
class Board {
 public:
  Board(std::vector<Job> jobs, long steps, const RunnerOptions& options)
      : jobs_(std::move(jobs)), options_(options), steps_(steps) {}

  void work();
  std::optional<Failure> failure() && { return std::move(failure_); }

 private:
  void do_job(const Job& job);
  std::optional<Failure> run(const Job& job, std::string& outcome);
  io::Insertion insert(const Job& job, Simulation& simulation, io::RunFolder& folder, StageCamera& camera);
  bool stopped();
  void advance(long steps);
  void finish(const Job& job, const std::string& outcome);
  void fail(const Job& job, const Failure& failure);

  const std::vector<Job> jobs_;
  const RunnerOptions& options_;
  std::atomic<std::size_t> next_{0};
  std::atomic<bool> stop_{false};
  std::mutex mutex_;
  const long steps_;
  long steps_done_ = 0;
  std::optional<Failure> failure_;
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

void Board::fail(const Job& job, const Failure& failure) {
  const std::lock_guard lock(mutex_);
  if (!failure_) failure_ = Failure{joined({"run ", job.name, ": ", failure.sentence}), failure.wrong_input};
  stop_ = true;
}

bool Board::stopped() {
  if (!stop_ && options_.interrupted && options_.interrupted()) stop_ = true;
  return stop_;
}

std::optional<Failure> Board::run(const Job& job, std::string& outcome) {
  const Scene& scene = job.run->scene;
  const std::string print = fingerprint(*job.run);
  if (options_.resume && is_finished(job.folder, print)) {
    outcome = "done before";
    advance(io::step_count(scene));
    return std::nullopt;
  }
  Result<Simulation> simulation = io::build_simulation(scene);
  if (!simulation) return Failure{simulation.error().sentence, true};
  mark_unfinished(job.folder);
  Result<io::RunFolder> folder = io::RunFolder::create(job.folder);
  if (!folder) return Failure{folder.error().sentence};
  StageCamera camera(*simulation);
  const io::Insertion insertion = insert(job, *simulation, *folder, camera);
  if (auto wrong = folder->finish(insertion)) return Failure{wrong->sentence};
  if (insertion.interrupted) return std::nullopt;
  outcome = name_of(acus::outcome(insertion.events));
  if (auto wrong = mark_finished(job.folder, camera.snapshots(*simulation), print))
    return Failure{wrong->sentence};
  return std::nullopt;
}

io::Insertion Board::insert(const Job& job, Simulation& simulation, io::RunFolder& folder,
                            StageCamera& camera) {
  constexpr int steps_between_signs = 100;
  int steps = -1, said = 0;  // the first state that is seen comes before every step
  const auto watch = [&](const Simulation& now) {
    if (!folder.record(now)) return false;
    camera.look(now);
    if (++steps - said >= steps_between_signs) advance(steps - std::exchange(said, steps));
    return !stopped();
  };
  const Scene& scene = job.run->scene;
  Hand hand(scene.hand, scene.run.time_step);
  const auto next = [&](const Frame& last) {
    return has_happened(job.run->until, simulation) ? std::nullopt : hand.next(last.hand_force);
  };
  io::Insertion insertion = io::run_insertion(simulation, next, watch);
  advance(io::step_count(scene) - said);
  return insertion;
}

void Board::do_job(const Job& job) {
  std::string outcome;
  if (const auto failure = run(job, outcome)) {
    fail(job, *failure);
  } else if (!stop_) {
    finish(job, outcome);
  }
}

// No exception leaves it: in a thread that would end the whole program.
void Board::work() {
  while (!stopped()) {
    const std::size_t mine = next_++;
    if (mine >= jobs_.size()) return;
    try {
      do_job(jobs_[mine]);
    } catch (const std::bad_alloc&) {
      fail(jobs_[mine], {"the memory of this machine does not suffice; take fewer --jobs or tetrahedra"});
    } catch (const std::exception& error) {
      fail(jobs_[mine], {joined({"stopped by an error of the program itself: ", error.what()})});
    }
  }
}

// Threads that work for a board; its end waits for theirs.
class Crew {
 public:
  Crew(Board& board, std::size_t size) {
    threads_.reserve(size);
    try {
      while (threads_.size() < size) threads_.emplace_back([&board] { board.work(); });
    } catch (const std::system_error&) {
      // The machine gives no more threads; those that there are do the same work.
    }
  }
  ~Crew() {
    for (std::thread& thread : threads_) thread.join();
  }
  Crew(const Crew&) = delete;
  Crew& operator=(const Crew&) = delete;

 private:
  std::vector<std::thread> threads_;
};

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

std::optional<Failure> do_runs(const Study& study, const RunnerOptions& options) {
  std::vector<Job> jobs = jobs_of(study, options.folder);
  const std::size_t workers = std::min(static_cast<std::size_t>(std::max(1, options.jobs)), jobs.size());
  Board board(std::move(jobs), step_count(study), options);
  {
    const Crew others(board, workers > 0 ? workers - 1 : 0);  // this thread is the first worker
    board.work();
  }
  return std::move(board).failure();
}

}  // namespace acus::study
