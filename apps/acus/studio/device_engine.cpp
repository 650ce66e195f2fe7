// An insertion that a haptic device leads. Pages watch it, arm and disarm the force, and choose other scenes.
#include <mutex>
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

class DeviceEngine final : public Engine {
 public:
  DeviceEngine(haptics::OpenDevice device, Simulation first, const DeviceSettings& settings)
      : device_(std::move(device)), simulation_(std::move(first)), settings_(settings) {}

  std::optional<std::string> device() const override { return device_.device->limits().title; }

  void take(const std::string& text) override {
    const Result<view::Command> command = view::parse_command(text);
    if (!command) return say(view::refused_report(command.error().sentence));
    std::visit([this](const auto& one) { obey(one); }, *command);
  }

  void let_go() override { control_.armed = false; }

  std::optional<Error> run(Broadcast& broadcast, const std::atomic<bool>& stop) override {
    broadcast_ = &broadcast;
    while (!stop) {
      broadcast.begin(view::model_report(simulation_), simulation_);
      const haptics::LoopOutcome outcome = hold(broadcast, stop);
      if (settings_.recorder != nullptr) {
        if (const auto failed = settings_.recorder->finish(simulation_.state_hash())) return failed;
        settings_.recorder = nullptr;  // of one insertion
      }
      std::fputs(haptics::in_words(outcome.report).c_str(), stdout);
      if (outcome.lost) return outcome.lost;
      if (outcome.report.health != Health::good)
        return Error{"the simulation failed: " + std::string(complaint(outcome.report.health))};
      const std::lock_guard lock(mutex_);
      if (next_) simulation_ = std::move(*next_);
      next_.reset();
      again_ = false;
    }
    return std::nullopt;
  }

 private:
  haptics::LoopOutcome hold(Broadcast& broadcast, const std::atomic<bool>& stop) {
    std::atomic<bool> over{false};
    std::size_t told = 0;
    StatusClock status;
    double stepped_to = 0.0;
    haptics::LoopSettings settings;
    settings.force_limit = settings_.force_limit;
    settings.recorder = settings_.recorder;
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
      if (const auto report = status.due(time, &loop, limit())) broadcast.status(*report);
    };
    return haptics::run_loop(*device_.device, simulation_, settings, over);
  }

  double limit() const {
    const double device = device_.device->limits().peak_force;
    return settings_.force_limit > 0.0 ? std::min(settings_.force_limit, device) : device;
  }

  void obey(const view::Start& start) {
    const Result<Scene> scene = io::parse_scene(start.scene.toml, "scene", start.scene.settings);
    if (!scene) return say(view::refused_report(scene.error().sentence));
    Result<Simulation> built = io::build_simulation(haptics::held_by(device_.device->limits(), *scene));
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
