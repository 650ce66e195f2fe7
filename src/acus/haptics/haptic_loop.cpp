#include "acus/haptics/haptic_loop.h"

#include <pthread.h>

#include <thread>
#include <utility>

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
  LoopStatus status;         // what the device's thread knows of it
};

struct Exchange {
  NewestValue<HandWord> hand;      // from the device's thread
  NewestValue<LocalForce> needle;  // from the simulation's
};

io::RecordedTick recorded(const DeviceState& state, const Wrench& wrench) {
  const auto three = [](const Vec3& v) {
    return std::array{static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z())};
  };
  return {state.time,
          {state.position.x(), state.position.y(), state.position.z()},
          three(state.velocity),
          three(wrench.force),
          state.buttons};
}

// The device's thread, once a tick.
class LoopTick final : public Tick {
 public:
  LoopTick(Exchange& exchange, const ServoSettings& servo, const LoopSettings& settings, LoopReport& report,
           const std::atomic<bool>& stop)
      : exchange_(exchange),
        servo_(servo),
        recorder_(settings.recorder),
        control_(settings.control),
        report_(report),
        stop_(stop) {}

  Wrench operator()(const DeviceState& state) noexcept override {
    const double start = monotonic_time();
    if (last_ > 0.0) report_.period.add(start - last_);
    last_ = start;
    const LocalForce& word = exchange_.needle.read();
    if (word.time >= 0.0) report_.age.add(state.time - word.time);
    if (stop_.load(std::memory_order_relaxed)) servo_.let_go();
    // Whoever holds the device says when the force may come back after a fault.
    if ((state.buttons & ~buttons_) != 0 || asked_to_arm()) servo_.rearm();
    buttons_ = state.buttons;
    const Wrench wrench = servo_.tick(as_controlled(state), word);
    if (stop_.load(std::memory_order_relaxed) && wrench.force.isZero() && wrench.torque.isZero())
      over_.store(true, std::memory_order_relaxed);
    exchange_.hand.write({servo_.hand(), state.time, start, status_after(wrench)});
    if (recorder_ != nullptr) recorder_->tick(recorded(state, state.ready ? wrench : Wrench{}));
    report_.largest_force = std::max(report_.largest_force, wrench.force.norm());
    report_.work.add(monotonic_time() - start);
    return wrench;
  }

  // A device whose force is not wanted is treated as one that is not ready: the needle stays where it is.
  DeviceState as_controlled(DeviceState state) const noexcept {
    if (control_ != nullptr) state.ready = state.ready && control_->armed && !control_->paused;
    return state;
  }

  bool asked_to_arm() noexcept {
    const long before = arm_requests_;
    if (control_ != nullptr) arm_requests_ = control_->arm_requests;
    return arm_requests_ != before;
  }

  LoopStatus status_after(const Wrench& wrench) noexcept {
    constexpr long stride = 128;  // ticks: to look through the histogram takes a microsecond
    if (report_.work.count() % stride == 0) {
      status_.late_ticks = report_.period.longer_than(late_tick);
      status_.tick_p999 = report_.work.quantile(0.999);
    }
    status_.device_force = wrench.force.norm();
    status_.gate = servo_.gate().state();
    status_.fault = servo_.gate().fault();
    return status_;
  }

  const Servo& servo() const { return servo_; }
  // Once it is to stop and the force has fallen to nothing.
  const std::atomic<bool>& over() const { return over_; }

 private:
  Exchange& exchange_;
  Servo servo_;
  Recorder* recorder_;
  const LoopControl* control_;
  LoopReport& report_;
  LoopStatus status_;
  const std::atomic<bool>& stop_;
  std::atomic<bool> over_{false};
  unsigned buttons_ = 0;
  long arm_requests_ = 0;
  double last_ = 0.0;  // s
};

// The simulation's thread: a step for each time step of the wall clock.
void simulate(Exchange& exchange, Simulation& simulation, LoopReport& report, const LoopSettings& settings,
              const std::atomic<bool>& stop) {
  pthread_setname_np(pthread_self(), needle_thread);
  HubSimulation needle(simulation);
  Pace pace(simulation.scene().run.time_step);
  GateFault told = GateFault::none;
  const double begin = monotonic_time(), from = simulation.frame().time;
  while (!stop.load(std::memory_order_relaxed)) {
    const HandWord hand = exchange.hand.read();
    LoopStatus status = hand.status;
    if (status.fault != std::exchange(told, status.fault) && settings.announce) settings.announce(told);
    const bool paused = settings.control != nullptr && settings.control->paused;
    if (hand.our_time >= 0.0 && simulation.frame().health == Health::good && !paused) {
      const double start = monotonic_time();
      const bool due = settings.recorder != nullptr && settings.recorder->hash_due();
      LocalForce word = needle.step(hand.motion, 0.0);
      if (settings.recorder != nullptr)
        settings.recorder->step(hand.motion.travel,
                                due ? std::optional(simulation.state_hash()) : std::nullopt);
      const double end = monotonic_time();
      if (simulation.frame().health == Health::good) {
        word.time = hand.device_time + (end - hand.our_time);
        exchange.needle.write(word);
      }
      report.step.add(end - start);
      status.load = (end - start) / report.time_step;
    }
    if (settings.watch) settings.watch(simulation, status);
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
  LoopTick tick(exchange, {device.limits(), settings.force_limit, settings.start_travel, 1e-3}, settings,
                report, stop);
  std::atomic<bool> over{false};
  std::thread simulating([&] { simulate(exchange, simulation, report, settings, over); });
  const RealTime real_time;
  report.not_real_time = real_time.refusal();
  outcome.lost = device.serve(tick, tick.over());
  over = true;
  simulating.join();
  report.fault = tick.servo().gate().fault();
  report.interventions = tick.servo().gate().interventions();
  report.lowered = tick.servo().lowered();
  return outcome;
}

}  // namespace acus::haptics
