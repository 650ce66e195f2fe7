#include "acus/haptics/haptic_loop.h"

#include <thread>

#include "acus/haptics/newest_value.h"
#include "acus/haptics/pace.h"
#include "acus/haptics/real_time.h"
#include "acus/haptics/servo.h"

namespace acus::haptics {
namespace {

// Where the hand is, and when: on the device's clock and on ours.
struct HandWord {
  HandMotion motion;
  double device_time = 0.0;  // s
  double our_time = -1.0;    // s; negative before the first tick
};

struct Exchange {
  NewestValue<HandWord> hand;      // from the device's thread
  NewestValue<LocalForce> needle;  // from the simulation's
};

// The device's thread, once a tick.
class LoopTick final : public Tick {
 public:
  LoopTick(Exchange& exchange, const ServoSettings& settings, LoopReport& report)
      : exchange_(exchange), servo_(settings), report_(report) {}

  Wrench operator()(const DeviceState& state) noexcept override {
    const double start = monotonic_time();
    if (last_ > 0.0) report_.period.add(start - last_);
    last_ = start;
    const LocalForce& word = exchange_.needle.read();
    if (word.time >= 0.0) report_.age.add(state.time - word.time);
    const Wrench wrench = servo_.tick(state, word);
    exchange_.hand.write({servo_.hand(), state.time, start});
    report_.largest_force = std::max(report_.largest_force, wrench.force.norm());
    report_.work.add(monotonic_time() - start);
    return wrench;
  }

  const ForceGate& gate() const { return servo_.gate(); }

 private:
  Exchange& exchange_;
  Servo servo_;
  LoopReport& report_;
  double last_ = 0.0;  // s
};

// The simulation's thread: a step for each time step of the wall clock.
void simulate(Exchange& exchange, Simulation& simulation, LoopReport& report, const std::atomic<bool>& stop) {
  HubSimulation needle(simulation);
  Pace pace(simulation.scene().run.time_step);
  const double begin = monotonic_time(), from = simulation.frame().time;
  while (!stop.load(std::memory_order_relaxed) && simulation.frame().health == Health::good) {
    const HandWord hand = exchange.hand.read();
    if (hand.our_time >= 0.0) {
      const double start = monotonic_time();
      LocalForce word = needle.step(hand.motion, 0.0);
      const double end = monotonic_time();
      if (simulation.frame().health == Health::good) {
        word.time = hand.device_time + (end - hand.our_time);
        exchange.needle.write(word);
      }
      report.step.add(end - start);
    }
    pace.wait();
  }
  report.wall_time = monotonic_time() - begin;
  report.simulated_time = simulation.frame().time - from;
  report.health = simulation.frame().health;
}

}  // namespace

LoopOutcome run_loop(Device& device, Simulation& simulation, const LoopSettings& settings,
                     const std::atomic<bool>& stop) {
  LoopOutcome outcome;
  LoopReport& report = outcome.report;
  report.time_step = simulation.scene().run.time_step;
  Exchange exchange;
  LoopTick tick(exchange, {device.limits(), settings.force_limit, settings.start_travel, 1e-3}, report);
  std::atomic<bool> over{false};
  std::thread simulating([&] { simulate(exchange, simulation, report, over); });
  const RealTime real_time;
  report.not_real_time = real_time.refusal();
  outcome.lost = device.serve(tick, stop);
  over = true;
  simulating.join();
  report.fault = tick.gate().fault();
  report.interventions = tick.gate().interventions();
  return outcome;
}

}  // namespace acus::haptics
