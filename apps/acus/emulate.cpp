// acus emulate: devices that are not there, speaking as the real ones do.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <thread>

#include "acus/base/units.h"
#include "acus/haptics/haply_emulator.h"
#include "acus/haptics/stop_after.h"
#include "interruption.h"
#include "verbs.h"

namespace acus::app {
namespace {

constexpr double waits = 1.0, rests = 2.0;  // s, before it goes and before it comes back

// The driver's library beside this program, or where it was installed.
std::filesystem::path emulator_library(const char* name) {
  std::error_code unknown;
  const std::filesystem::path here = std::filesystem::read_symlink("/proc/self/exe", unknown).parent_path();
  for (const std::filesystem::path& folder : {here / "emulators", here.parent_path() / ACUS_EMULATORS})
    if (std::filesystem::exists(folder / name, unknown)) return folder / name;
  return {};
}

int tell_how(const char* name, const char* variable, const char* device) {
  const std::filesystem::path library = emulator_library(name);
  if (library.empty())
    return refused(
        std::string("the emulator ") + name + " is neither beside this program nor installed with it",
        run_failed);
  std::printf(
      "An emulator of %s, with a device and a hand in it that are not there. It is no process of its own: "
      "acus\n"
      "loads it in the place of the driver.\n\n"
      "  export %s=%s\n"
      "  export ACUS_EMULATED_HAND=1   # somebody tries a needle: 40 mm forward after a second, then back\n"
      "  acus device check %s\n"
      "  acus serve scenes/paper_200.toml --device %s\n",
      name, variable, library.c_str(), device, device);
  return done;
}

}  // namespace

int do_emulate_haply(const EmulateHaplyOptions& options) {
  haptics::HaplyEmulatorSettings settings;
  settings.port = static_cast<unsigned short>(options.port);
  settings.dialect =
      options.service == "3.5" ? haptics::haply::Dialect::vector : haptics::haply::Dialect::values;
  for (const std::string& text : options.faults) {
    const Result<haptics::HaplyFault> fault = haptics::haply_fault(text);
    if (!fault) return refused(fault.error().sentence, bad_input);
    settings.faults.push_back(*fault);
  }
  const double way = options.way * units::mm, speed = options.speed * units::mm;
  settings.plan = [=](double time) {
    const double out = std::clamp(speed * (time - waits), 0.0, way);
    return out - std::clamp(speed * (time - waits - rests) - way, 0.0, way);
  };
  const auto emulator = haptics::HaplyEmulator::start(std::move(settings));
  if (!emulator) return refused(emulator.error().sentence, bad_input);
  std::printf(
      "An emulator of the Haply Inverse Service %s: no device is there, and nothing here proves anything "
      "about a real "
      "one.\n"
      "It listens on port %d: acus serve scenes/paper_200.toml --device haply:%d\nCtrl-C ends it.\n",
      options.service.c_str(), (*emulator)->port(), (*emulator)->port());
  std::fflush(stdout);
  catch_interruptions();
  const haptics::StopAfter stop(options.seconds, interruption_flag());
  while (!stop.flag()) std::this_thread::sleep_for(std::chrono::milliseconds(20));
  std::printf("%ld commands came.\n", (*emulator)->came());
  return done;
}

int do_emulate_openhaptics() { return tell_how("libHD.so", "ACUS_LIBHD", "openhaptics"); }
int do_emulate_force_dimension() { return tell_how("libdhd.so", "ACUS_LIBDHD", "force_dimension"); }

}  // namespace acus::app
