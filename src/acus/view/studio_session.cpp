#include "acus/view/studio_session.h"

#include <algorithm>
#include <cmath>
#include <new>

#include "acus/io/scene_toml.h"
#include "acus/sim/summary.h"
#include "acus/view/reports.h"

namespace acus::view {
namespace {

// A page that sends nonsense and never listens does not fill the memory.
constexpr std::size_t most_reports = 10000;

// Errors name a setting as the command line spells it; a page shows it without.
std::string without_option(const std::string& sentence, const std::vector<std::string>& settings) {
  for (const std::string& setting : settings) {
    const std::string where = "--set " + setting + ": ";
    if (sentence.starts_with(where)) return sentence.substr(where.size());
  }
  return sentence;
}

}  // namespace

Result<Simulation> build_without_files(const Scene& scene, int threads) {
  if (!scene.tissue.rigid && !scene.tissue.mesh.empty())
    return Error{
        "tissue.mesh names a file, and an engine in a browser has none; leave it out for a block, or use "
        "acus "
        "serve"};
  return Simulation::build(scene, nullptr, threads);
}

// What each command does.
struct StudioSession::Taker {
  StudioSession& s;

  void operator()(const Start& c) const { s.start(c.scene); }
  void operator()(const Check& c) const { s.check(c.scene); }
  void operator()(const Push& c) const {
    if (s.can_move()) s.hand_.push(c.travel);
  }
  void operator()(const Steady& c) const {
    if (s.can_move()) s.hand_.steady(c.speed);
  }
  void operator()(const Pause&) const { s.paused_ = true; }
  void operator()(const Resume&) const {
    s.paused_ = false;
    s.steps_asked_for_ = 0;
  }
  void operator()(const Step& c) const {
    if (!s.can_move()) return;
    if (!s.paused_) return s.refuse("single steps are for an insertion that is paused; pause it first");
    s.steps_asked_for_ = c.steps;
  }
  void operator()(const Rate& c) const { s.rate_ = c.factor; }
  void operator()(const Arm&) const { s.refuse("there is no device here whose force could be armed"); }
  void operator()(const Disarm&) const { s.refuse("there is no device here whose force could be disarmed"); }
  void operator()(const Hold&) const {}
};

StudioSession::StudioSession(Source source) : source_(std::move(source)) {
  report(hello_report(source_.name, source_.device));
}

void StudioSession::take(std::string_view command) {
  const Result<Command> parsed = parse_command(command);
  if (!parsed) return refuse(parsed.error().sentence);
  try {
    std::visit(Taker{*this}, *parsed);
  } catch (const std::bad_alloc&) {
    refuse(out_of_memory);
  }
}

void StudioSession::refuse(const std::string& sentence) {
  if (reports_.size() < most_reports) report(refused_report(sentence));
}

Result<Scene> StudioSession::scene_of(const SceneChoice& choice) const {
  Result<Scene> scene = io::parse_scene(choice.toml, "scene", choice.settings);
  if (!scene) return Error{without_option(scene.error().sentence, choice.settings)};
  return scene;
}

void StudioSession::start(const SceneChoice& choice) {
  const Result<Scene> scene = scene_of(choice);
  if (!scene) return refuse(scene.error().sentence);
  Result<Simulation> built = source_.build(*scene, source_.threads);
  if (!built) return refuse(built.error().sentence);
  // Nothing of the old insertion is touched until all that can fail is done.
  FrameScratch scratch = build_frame_scratch(*built);
  std::vector<std::byte> frame(frame_size(*built));
  std::string model = model_report(*built);
  report(std::move(model));
  simulation_ = std::move(built).value();
  scratch_ = std::move(scratch);
  frame_ = std::move(frame);
  hand_ = LedHand(*scene);
  events_told_ = 0;
  paused_ = ended_ = false;
  owed_ = 0.0;
  steps_asked_for_ = 0;
}

void StudioSession::check(const SceneChoice& choice) {
  const Result<Scene> scene = scene_of(choice);
  if (!scene) return refuse(scene.error().sentence);
  report(expectation_report(*scene));
}

bool StudioSession::can_move() {
  if (!simulation_)
    refuse("there is no insertion yet; start one first");
  else if (ended_)
    refuse("this insertion has ended; start a new one");
  return simulation_ && !ended_;
}

int StudioSession::steps_due(double seconds, int most_steps) {
  if (paused_) {
    const int steps = std::min(steps_asked_for_, most_steps);
    steps_asked_for_ -= steps;
    return steps;
  }
  const double time_step = simulation_->scene().run.time_step;
  constexpr double longest = 1.0;  // s: a page that slept does not catch up
  if (seconds > 0.0) owed_ += rate_ * std::min(seconds, longest);
  const double steps = std::floor(owed_ / time_step);
  owed_ -= steps * time_step;
  return static_cast<int>(std::min<double>(steps, most_steps));  // what is more is not made up for
}

void StudioSession::step() {
  const Frame& frame = simulation_->step(hand_.advance(simulation_->scene().run.time_step));
  for (const auto events = simulation_->events(); events_told_ < events.size(); ++events_told_)
    report(event_report(events[events_told_]));
  if (frame.health == Health::good) return;
  ended_ = true;
  report(failed_report(complaint(frame.health)));
}

int StudioSession::advance(double seconds, int most_steps) {
  if (!simulation_ || ended_) return 0;
  int taken = 0;
  for (const int due = steps_due(seconds, most_steps); taken < due && !ended_; ++taken) step();
  return taken;
}

std::optional<std::string> StudioSession::next_report() {
  if (reports_.empty()) return std::nullopt;
  std::string text = std::move(reports_.front());
  reports_.pop_front();
  return text;
}

std::span<const std::byte> StudioSession::frame() {
  if (simulation_) frame_into(frame_, *simulation_, scratch_);
  return frame_;
}

}  // namespace acus::view
