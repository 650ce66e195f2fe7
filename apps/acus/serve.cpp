// acus serve: the studio on this machine, and a device at the needle where one is named.
#include <fcntl.h>
#include <spawn.h>

#include <cstdio>
#include <cstdlib>
#include <optional>

#include "acus/haptics/stop_after.h"
#include "acus/haptics/virtual_coupling.h"
#include "acus/io/insertion.h"
#include "acus/io/scene_toml.h"
#include "interruption.h"
#include "studio/studio_server.h"
#include "verbs.h"

extern char** environ;

namespace acus::app {
namespace {

// On a desktop the browser opens by itself. It lives on when we end: it gets nothing of ours, neither the
// port nor the connection to a device, and Ctrl-C is not for it.
void open_in_browser(const std::string& address) {
  if (std::getenv("DISPLAY") == nullptr && std::getenv("WAYLAND_DISPLAY") == nullptr) return;
  std::string program = "xdg-open", target = address;
  char* words[] = {program.data(), target.data(), nullptr};
  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  for (int standard = 0; standard < 3; ++standard)
    posix_spawn_file_actions_addopen(&files, standard, "/dev/null", O_RDWR, 0);
  posix_spawn_file_actions_addclosefrom_np(&files, 3);
  posix_spawnattr_t session;
  posix_spawnattr_init(&session);
  posix_spawnattr_setflags(&session, POSIX_SPAWN_SETSID);
  pid_t child = 0;
  posix_spawnp(&child, words[0], &files, &session, words, environ);
  posix_spawnattr_destroy(&session);
  posix_spawn_file_actions_destroy(&files);
}

struct Served {
  std::string words;  // about the device, where there is one
  std::unique_ptr<Engine> engine;
};

// A page leads the hand.
Result<Served> serve_pages(const Scene& scene, const ServeOptions& options) {
  if (options.record_given) return Error{"--record needs a --device; a page keeps its own recordings"};
  Served served;
  served.engine = led_engine(scene, options.threads);
  return served;
}

// A device does.
Result<Served> serve_device(const Scene& scene, const ServeOptions& options) {
  Result<haptics::OpenDevice> opened = haptics::open_device(options.device);
  if (!opened) return opened.error();
  const haptics::DeviceLimits& limits = opened->device->limits();
  Result<Simulation> simulation = io::build_simulation(haptics::held_by(limits, scene), options.threads);
  if (!simulation) return Error{options.scene + ": " + simulation.error().sentence};
  Served served;
  served.words =
      limits.title + " (" + opened->by->proof +
      ") shows the needle now; it is felt from 5 mm ahead of where the handle is when it becomes ready.\n";
  served.engine =
      device_engine(std::move(opened).value(), std::move(simulation).value(),
                    {options.force_limit, options.record_given ? std::optional(options.record) : std::nullopt,
                     options.threads});
  return served;
}

}  // namespace

int do_serve(const ServeOptions& options) {
  const Result<Scene> scene = options.scene.empty() ? io::parse_scene("", "scene", options.settings)
                                                    : io::read_scene(options.scene, options.settings);
  if (!scene) return refused(scene.error().sentence, bad_input);
  Result<Served> served =
      options.device.empty() ? serve_pages(*scene, options) : serve_device(*scene, options);
  if (!served) return refused(served.error().sentence, bad_input);
  const auto studio = StudioServer::start(static_cast<unsigned short>(options.port), *served->engine);
  if (!studio) return refused(studio.error().sentence, bad_input);
  std::printf(
      "Research and training simulator, not a medical device.\n%sThe studio, for a browser on this machine: "
      "%s\n"
      "Ctrl-C ends it.\n",
      served->words.c_str(), (*studio)->address().c_str());
  std::fflush(stdout);
  catch_interruptions();
  if (options.opens_browser) open_in_browser((*studio)->address());
  const haptics::StopAfter stop(options.seconds, interruption_flag());
  const std::optional<Error> failed = (*studio)->run(stop.flag());
  return failed ? refused(failed->sentence, run_failed) : done;
}

}  // namespace acus::app
