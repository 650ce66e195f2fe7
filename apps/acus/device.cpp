// acus device: which devices there are, and a first look at one.
#include <algorithm>
#include <atomic>
#include <cstdio>

#include "acus/haptics/backends.h"
#include "acus/haptics/device_check.h"
#include "interruption.h"
#include "verbs.h"

namespace acus::app {

int do_device_list() {
  for (const haptics::Backend& backend : haptics::backends()) {
    const std::string missing = backend.missing();
    std::printf("%-16s %s (%s)\n%-16s %s\n", backend.name, backend.title, backend.proof, "",
                missing.empty() ? "ready" : missing.c_str());
  }
  std::printf("\nResearch and training simulator, not a medical device.\n");
  return done;
}

int do_device_check(const std::string& name) {
  const Result<haptics::OpenDevice> opened = haptics::open_device(name);
  if (!opened) return refused(opened.error().sentence, bad_input);
  haptics::Device& device = *opened->device;
  constexpr double duration = 6.0;  // s
  std::printf(
      "Research and training simulator, not a medical device.\n"
      "Hold %s (%s) loosely: for %g s it pushes towards you with at most half a newton. Ctrl-C ends it.\n",
      device.limits().title.c_str(), opened->by->proof, duration);
  std::fflush(stdout);
  catch_interruptions();
  const haptics::DeviceCheck check = haptics::check_device(device, duration, interruption_flag());
  std::fputs(haptics::in_words(check, device.limits()).c_str(), stdout);
  if (check.lost) return refused(check.lost->sentence, run_failed);
  if (interrupted()) return refused("interrupted", run_failed);
  return check.ready_ticks > 0 && check.fault == haptics::GateFault::none
             ? static_cast<int>(done)
             : refused("the device did not pass", run_failed);
}

}  // namespace acus::app
