// An insertion whose hand the pages lead: the session that also runs in a browser, on a thread of its own.
#include <algorithm>
#include <chrono>
#include <mutex>
#include <nlohmann/json.hpp>
#include <thread>
#include <vector>

#include "acus/haptics/pace.h"
#include "acus/io/insertion.h"
#include "acus/io/scene_toml.h"
#include "acus/view/reports.h"
#include "acus/view/studio_session.h"
#include "engine.h"
#include "loop_status.h"

namespace acus::app {
namespace {

class LedEngine final : public Engine {
 public:
  LedEngine(const Scene& scene, int threads)
      : session_({"serve", std::nullopt, io::build_simulation, threads}) {
    session_.next_report();  // hello, which the server says itself
    session_.take(nlohmann::json{{"type", "start"}, {"scene", io::scene_toml(scene)}}.dump());
  }

  void take(const std::string& command) override {
    const std::lock_guard lock(mutex_);
    commands_.push_back(command);
  }

  void let_go() override { take(R"({"type":"steady","speed_m_s":0})"); }

  std::optional<Error> run(Broadcast& broadcast, const std::atomic<bool>& stop) override {
    constexpr std::chrono::milliseconds between(2);
    constexpr double longest_gap = 0.1;  // s: what is not simulated of it is left out, in slow motion
    StatusClock status;
    double before = haptics::monotonic_time();
    while (!stop) {
      take_commands();
      const double now = haptics::monotonic_time();
      const int steps = advance(std::min(now - before, longest_gap), now);
      const double busy = haptics::monotonic_time() - now;
      tell(broadcast);
      if (const Simulation* simulation = session_.simulation()) {
        broadcast.show(*simulation, now);
        status.stepped(steps * simulation->scene().run.time_step, busy);
        if (const auto report = status.due(now, session_.paused())) broadcast.status(*report);
      }
      before = now;
      std::this_thread::sleep_for(between);
    }
    return std::nullopt;
  }

 private:
  void take_commands() {
    std::vector<std::string> commands;
    {
      const std::lock_guard lock(mutex_);
      commands.swap(commands_);
    }
    for (const std::string& command : commands) session_.take(command);
  }

  // Lets `seconds` pass, but not for long at a stretch: commands are to be heard, and frames shown.
  int advance(double seconds, double now) {
    constexpr double slice = 2e-3, at_a_stretch = 12e-3;  // s
    int steps = 0;
    for (; seconds > 0.0 && haptics::monotonic_time() - now < at_a_stretch; seconds -= slice)
      steps += session_.advance(std::min(seconds, slice));
    return steps;
  }

  void tell(Broadcast& broadcast) {
    while (std::optional<std::string> report = session_.next_report()) {
      if (report->starts_with(R"({"type":"model")"))
        broadcast.begin(std::move(*report), *session_.simulation());
      else if (report->starts_with(R"({"type":"event")") || report->starts_with(R"({"type":"failed")"))
        broadcast.keep(std::move(*report));
      else
        broadcast.pass(std::move(*report));
    }
  }

  view::StudioSession session_;
  std::mutex mutex_;  // of the following
  std::vector<std::string> commands_;
};

}  // namespace

std::unique_ptr<Engine> led_engine(const Scene& scene, int threads) {
  return std::make_unique<LedEngine>(scene, threads);
}

}  // namespace acus::app
