// Insertions that a haptic device leads. Pages watch them, arm and disarm the force, and choose other scenes.
#include <filesystem>
#include <mutex>
#include <new>
#include <utility>

#include "acus/haptics/pace.h"
#include "acus/haptics/virtual_coupling.h"
#include "acus/io/insertion.h"
#include "acus/io/scene_toml.h"
#include "acus/sim/summary.h"
#include "acus/view/command.h"
#include "acus/view/reports.h"
#include "engine.h"
#include "loop_status.h"

namespace acus::app {
namespace {

// Of the recordings beside `file`, the first that is not there yet: hand-2.acusrec beside hand.acusrec.
std::string next_file(const std::string& file) {
  const std::filesystem::path first(file);
  for (int number = 2;; ++number) {
    std::filesystem::path next = first;
    next.replace_filename(first.stem().string() + "-" + std::to_string(number) + first.extension().string());
    std::error_code unknown;
    if (!std::filesystem::exists(next, unknown)) return next.string();
  }
}

class DeviceEngine final : public Engine {
 public:
  DeviceEngine(haptics::OpenDevice device, Simulation first, DeviceSettings settings)
      : device_(std::move(device)), simulation_(std::move(first)), settings_(std::move(settings)) {}

  std::optional<std::string> device() const override { return device_.device->limits().title; }

  std::optional<Error> begin() override {
    return settings_.record ? record_into(*settings_.record) : std::nullopt;
  }

  void take(const std::string& text) override {
    const Result<view::Command> command = view::parse_command(text);
    if (!command) return say(view::refused_report(command.error().sentence));
    try {
      std::visit([this](const auto& one) { obey(one); }, *command);
    } catch (const std::bad_alloc&) {
      say(view::refused_report(view::out_of_memory));
    }
  }

  void let_go() override { control_.armed = false; }

  std::optional<Error> run(Broadcast& broadcast, const std::atomic<bool>& stop) override {
    broadcast_ = &broadcast;
    std::optional<Error> unrecorded;
    while (!stop) {
      broadcast.begin(view::model_report(simulation_), simulation_);
      const haptics::LoopOutcome outcome = hold(broadcast, stop);
      if (const auto failed = finish_recording()) unrecorded = failed;
      std::fputs(haptics::in_words(outcome.report).c_str(), stdout);
      if (outcome.lost) return outcome.lost;
      if (!take_next()) {
        if (outcome.report.health != Health::good)
          return Error{"the simulation failed: " + std::string(complaint(outcome.report.health))};
      } else if (const auto refused = record_next()) {
        unrecorded = refused;
      }
      std::fflush(stdout);
    }
    return unrecorded;
  }

 private:
  haptics::LoopOutcome hold(Broadcast& broadcast, const std::atomic<bool>& stop) {
    std::atomic<bool> over{false};
    std::size_t told = 0;
    StatusClock status;
    double stepped_to = 0.0;
    haptics::LoopSettings settings;
    settings.force_limit = settings_.force_limit;
    settings.recorder = recorder_.get();
    settings.control = &control_;
    settings.announce = [](haptics::GateFault fault) {
      std::printf(
          "%s\n",
          fault == haptics::GateFault::none
              ? "The force is armed again."
              : ("Force off: " + haptics::in_words(fault) +
                 ". A button of the device arms it again, once the needle pushes with less than 0.2 N.")
                    .c_str());
      std::fflush(stdout);
    };
    bool told_failure = false;
    settings.watch = [&](const Simulation& now, const haptics::LoopStatus& loop) {
      if (now.frame().health != Health::good && !std::exchange(told_failure, true))
        broadcast.keep(view::failed_report("the simulation failed, and the force goes: " +
                                           std::string(complaint(now.frame().health))));
      if (stop || again_) over = true;
      for (const auto events = now.events(); told < events.size(); ++told)
        broadcast.keep(view::event_report(events[told]));
      const double time = haptics::monotonic_time(), simulated = now.frame().time - stepped_to;
      stepped_to = now.frame().time;
      status.stepped(simulated, loop.load * simulated);
      broadcast.show(now, time);
      if (const auto report = status.due(time, control_.paused, &loop, limit())) broadcast.status(*report);
    };
    return haptics::run_loop(*device_.device, simulation_, settings, over);
  }

  std::optional<Error> record_into(const std::string& file) {
    auto recorder = haptics::Recorder::start(file, simulation_.scene(), "--record");
    if (!recorder) return recorder.error();
    recorder_ = std::move(*recorder);
    return std::nullopt;
  }

  // What went wrong with it; the pages are told too.
  std::optional<Error> record_next() {
    if (!settings_.record) return std::nullopt;
    const std::string file = next_file(*settings_.record);
    std::optional<Error> failed = record_into(file);
    if (failed)
      say(view::refused_report("this insertion is not recorded: " + failed->sentence));
    else
      std::printf("The next insertion is recorded into %s.\n", file.c_str());
    return failed;
  }

  // The same of the recording that ends.
  std::optional<Error> finish_recording() {
    if (recorder_ == nullptr) return std::nullopt;
    std::optional<Error> failed = recorder_->finish(simulation_.state_hash());
    recorder_.reset();
    if (failed) say(view::refused_report(failed->sentence));
    return failed;
  }

  // Whether somebody has chosen another insertion; then it is the present one, and its time runs.
  bool take_next() {
    const std::lock_guard lock(mutex_);
    again_ = false;
    if (!next_) return false;
    simulation_ = std::move(*next_);
    next_.reset();
    control_.paused = false;
    return true;
  }

  double limit() const {
    const double device = device_.device->limits().peak_force;
    return settings_.force_limit > 0.0 ? std::min(settings_.force_limit, device) : device;
  }

  void obey(const view::Start& start) {
    const Result<Scene> scene = io::parse_scene(start.scene.toml, "scene", start.scene.settings);
    if (!scene) return say(view::refused_report(scene.error().sentence));
    Result<Simulation> built =
        io::build_simulation(haptics::held_by(device_.device->limits(), *scene), settings_.threads);
    if (!built) return say(view::refused_report(built.error().sentence));
    const std::lock_guard lock(mutex_);
    next_ = std::move(built).value();
    again_ = true;
  }
  void obey(const view::Pause&) { control_.paused = true; }
  void obey(const view::Resume&) { control_.paused = false; }
  void obey(const view::Arm&) {
    control_.armed = true;
    ++control_.arm_requests;
  }
  void obey(const view::Disarm&) { control_.armed = false; }
  template <class Other>
  void obey(const Other&) {
    say(view::refused_report(
        "the device leads the hand, in real time: this is for an insertion without one"));
  }

  void say(std::string report) {
    if (broadcast_ != nullptr) broadcast_.load()->pass(std::move(report));
  }

  haptics::OpenDevice device_;
  Simulation simulation_;
  DeviceSettings settings_;
  std::unique_ptr<haptics::Recorder> recorder_;  // of this insertion
  haptics::LoopControl control_;
  std::atomic<Broadcast*> broadcast_{nullptr};
  std::atomic<bool> again_{false};  // with another scene
  std::mutex mutex_;                // of the following
  std::optional<Simulation> next_;
};

}  // namespace

std::unique_ptr<Engine> device_engine(haptics::OpenDevice device, Simulation first,
                                      const DeviceSettings& settings) {
  return std::make_unique<DeviceEngine>(std::move(device), std::move(first), settings);
}

}  // namespace acus::app
