// A device at the needle while another process floods the server: quiet and flooded in turns. What guarantees
// that the servo does not notice is asserted: its ticks allocate nothing and wait for no lock, whoever
// shouts. How long they take is printed, for docs/server.md. ACUS_FLOODS says how often.
#include <gtest/gtest.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <vector>

#include "acus/haptics/simulated_device.h"
#include "acus/haptics/virtual_coupling.h"
#include "page.h"
#include "tests/counted_allocations.h"
#include "tests/counted_locks.h"
#include "tests/net/raw_socket.h"

namespace acus::app {
namespace {

constexpr int shouting = 4, deaf = 4;  // clients of each kind
constexpr double window = 2.0;         // s, quiet or flooded
constexpr double settling = 0.3;       // s, at the beginning of a window; not counted

constexpr long many = 1'000'000;  // messages, at least

int rounds() {
  const char* text = std::getenv("ACUS_FLOODS");
  return text != nullptr ? std::atoi(text) : 1;
}

// --- the other process

// What the two share.
struct Shared {
  std::atomic<bool> flooding{false}, over{false};
  std::atomic<long> messages{0}, shown_the_door{0}, deaf_clients{0};
};

// Where the server is; through a pipe.
struct Address {
  unsigned short port = 0;
  char token[64] = {};
};

// As long as it floods: shouts, and comes again whenever it is shown the door.
void shout(Shared& shared, unsigned short port, const std::string& token) {
  constexpr int in_a_breath = 100;
  std::string breath;
  for (int i = 0; i < in_a_breath; ++i)
    breath += net::text_frame(i % 10 == 0 ? R"({"type":"check","scene":""})" : R"({"type":"hold"})");
  while (shared.flooding) {
    const net::RawSocket socket(port);
    if (!socket.sends(net::socket_request(port, token))) continue;
    socket.read_to("\r\n\r\n");
    while (shared.flooding && socket.sends(breath)) shared.messages += in_a_breath;
    if (shared.flooding) ++shared.shown_the_door;
  }
}

// As long as it floods: asks for everything and never reads it; comes again when it is given up.
void be_deaf(Shared& shared, unsigned short port, const std::string& token) {
  while (shared.flooding) {
    const net::RawSocket socket(port);
    if (!socket.sends(net::socket_request(port, token))) continue;
    ++shared.deaf_clients;
    while (shared.flooding && !socket.is_closed_within(0.01)) {
    }
  }
}

[[noreturn]] void flood(Shared& shared, unsigned short port, const std::string& token) {
  std::vector<std::thread> clients;
  const auto whenever_it_floods = [&](auto client) {
    clients.emplace_back([&shared, port, &token, client] {
      for (; !shared.over; std::this_thread::sleep_for(std::chrono::milliseconds(1)))
        client(shared, port, token);
    });
  };
  for (int i = 0; i < shouting; ++i) whenever_it_floods(shout);
  for (int i = 0; i < deaf; ++i) whenever_it_floods(be_deaf);
  for (std::thread& client : clients) client.join();
  _exit(0);
}

// --- the device

// What was seen of the ticks of one kind of window.
struct Ticks {
  std::vector<double> work, lateness;  // s
  long allocations = 0, locks = 0;
  double simulated = 0.0, passed = 0.0;  // s

  Ticks() {
    constexpr std::size_t most = 1'000'000;  // a quarter of an hour
    work.reserve(most);
    lateness.reserve(most);
  }
};

double quantile(std::vector<double> values, double q) {
  if (values.empty()) return 0.0;
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(q * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

// A simulated device that takes the time of each tick.
class Timed final : public haptics::Device {
 public:
  explicit Timed(std::atomic<Ticks*>& now) : now_(now) {}
  const haptics::DeviceLimits& limits() const override { return device_.limits(); }
  std::optional<Error> serve(haptics::Tick& tick, const std::atomic<bool>& stop) override {
    Timing timing(tick, now_);
    return device_.serve(timing, stop);
  }

 private:
  class Timing final : public haptics::Tick {
   public:
    Timing(haptics::Tick& tick, std::atomic<Ticks*>& now) : tick_(tick), now_(now) {}
    haptics::Wrench operator()(const haptics::DeviceState& state) noexcept override {
      const long allocated = allocations, locked = locks;
      const double begin = haptics::monotonic_time();
      const haptics::Wrench wrench = tick_(state);
      const double end = haptics::monotonic_time();
      if (Ticks* ticks = now_; ticks != nullptr && ticks->work.size() < ticks->work.capacity()) {
        ticks->allocations += allocations - allocated;
        ticks->locks += locks - locked;
        ticks->work.push_back(end - begin);
        ticks->lateness.push_back(std::max(begin - last_ - 1e-3, 0.0));
      }
      last_ = begin;
      return wrench;
    }

   private:
    haptics::Tick& tick_;
    std::atomic<Ticks*>& now_;
    double last_ = haptics::monotonic_time();  // s
  };

  std::atomic<Ticks*>& now_;
  haptics::SimulatedDevice device_{*haptics::find_device_limits("touch"), haptics::light_grip,
                                   [](double t) { return 10e-3 * (1.0 - std::cos(t)); }};
};

// --- the measurement

void print(const char* what, const Ticks& quiet, const Ticks& flooded, const Ticks& again,
           std::vector<double> Ticks::*of) {
  for (const double q : {0.9, 0.99, 0.999}) {
    const double before = 1e6 * quantile(quiet.*of, q), during = 1e6 * quantile(flooded.*of, q),
                 after = 1e6 * quantile(again.*of, q);
    std::printf("%-10s p%-5g %8.2f us quiet %8.2f us flooded (%+.1f %%) %8.2f us quiet again (%+.1f %%)\n",
                what, 100.0 * q, before, during, 100.0 * (during / before - 1.0), after,
                100.0 * (after / before - 1.0));
  }
}

// A page that behaves: it leads, and sees the simulation's time.
class Leader {
 public:
  explicit Leader(const Running& server)
      : thread_([this, &server] {
          Page page(server);
          while (!over_) {
            page.say({{"type", "hold"}});
            simulated_ = page.number(0);
          }
        }) {}
  ~Leader() {
    over_ = true;
    thread_.join();
  }
  double simulated() const { return simulated_; }  // s

 private:
  std::atomic<bool> over_{false};
  std::atomic<double> simulated_{0.0};
  std::thread thread_;
};

TEST(Flood, leaves_the_ticks_of_the_servo_alone) {
  void* both = mmap(nullptr, sizeof(Shared), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  ASSERT_NE(both, MAP_FAILED);
  auto& shared = *new (both) Shared;
  int way[2];
  ASSERT_EQ(pipe(way), 0);
  const pid_t child = fork();  // before there are threads
  if (child == 0) {
    Address at;
    if (read(way[0], &at, sizeof at) != sizeof at) _exit(1);
    flood(shared, at.port, std::string(at.token, sizeof at.token));
  }
  Scene scene;
  scene.tissue.tetrahedra = 500;
  scene.run.time_step = 2e-3;
  scene.needle.length = 0.1;
  std::atomic<Ticks*> now{nullptr};
  haptics::OpenDevice device{&haptics::backends()[0], std::make_unique<Timed>(now)};
  Result<Simulation> simulation = Simulation::build(haptics::held_by(device.device->limits(), scene));
  Ticks quiet, flooded, again;
  {
    const Running server(device_engine(std::move(device), std::move(simulation).value(), {}));
    const Leader leader(server);
    Address at{server.port()};
    server.token().copy(at.token, sizeof at.token);
    ASSERT_EQ(write(way[1], &at, sizeof at), static_cast<ssize_t>(sizeof at));
    const auto wait = [](double seconds) {
      std::this_thread::sleep_for(std::chrono::duration<double>(seconds));
    };
    for (int round = 0; round < rounds() || shared.messages < many; ++round)
      for (Ticks* ticks : {&quiet, &flooded, &again}) {
        shared.flooding = ticks == &flooded;
        wait(settling);
        const double simulated = leader.simulated(), begin = haptics::monotonic_time();
        now = ticks;
        wait(window);
        now = nullptr;
        ticks->simulated += leader.simulated() - simulated;
        ticks->passed += haptics::monotonic_time() - begin;
      }
    shared.flooding = false;
    shared.over = true;
    EXPECT_EQ(waitpid(child, nullptr, 0), child);
  }
  std::printf("%ld messages of %d clients, %ld times shown the door; %ld times one of %d that never read\n",
              shared.messages.load(), shouting, shared.shown_the_door.load(), shared.deaf_clients.load(),
              deaf);
  std::printf("real time %.2f quiet, %.2f flooded, %.2f quiet again; %zu, %zu and %zu ticks\n",
              quiet.simulated / quiet.passed, flooded.simulated / flooded.passed,
              again.simulated / again.passed, quiet.work.size(), flooded.work.size(), again.work.size());
  print("work", quiet, flooded, again, &Ticks::work);
  print("lateness", quiet, flooded, again, &Ticks::lateness);
  EXPECT_GT(shared.shown_the_door, 0);
  EXPECT_GE(shared.deaf_clients, deaf);
  EXPECT_EQ(flooded.allocations, 0);
  EXPECT_EQ(flooded.locks, 0);
}

}  // namespace
}  // namespace acus::app
