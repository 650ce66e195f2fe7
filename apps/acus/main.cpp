// What a user may type: every verb, its options and how wrong ones are refused. The work of a verb is in its
// own file; this is the only one that parses CLI11, which is heavy.
#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <functional>
#include <iostream>
#include <memory>

#include "acus/base/team.h"
#include "acus/io/spelling.h"
#include "acus/sim/scene_keys.h"
#include "verbs.h"

namespace acus::app {

int refused(const std::string& sentence, ExitCode code) {
  std::cerr << "acus: " << sentence << "\n";
  return code;
}

namespace {

using Work = std::function<int()>;

// CLI::Range alone lets through what is no number.
CLI::Validator number_from(double least, double most) {
  const CLI::Validator is_one(
      [](const std::string& text) {
        return std::isnan(std::strtod(text.c_str(), nullptr)) ? text + " is no number" : std::string();
      },
      "");
  return is_one & CLI::Range(least, most);
}

// The option --set key=value, which may stand many times.
void add_settings(CLI::App& verb, std::vector<std::string>& settings) {
  verb.add_option("--set", settings,
                  "lay a value over the scene, as in --set needle.length_mm=150; may be repeated")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
}

void add_threads(CLI::App& verb, int& threads) {
  verb.add_option(
          "--threads", threads,
          "threads that share a step; it pays from 6 000 tetrahedra on and changes no bit of a result")
      ->type_name("N")
      ->check(CLI::Range(1, most_threads))
      ->capture_default_str();
}

void add_output(CLI::App& verb, OutputOptions& options) {
  verb.add_option("--out", options.out,
                  "folder for trace.csv, events.csv and summary.json; without it nothing is written")
      ->type_name("DIR")
      ->each([&options](const std::string&) { options.out_given = true; });
  verb.add_option("--vtu-every", options.vtu_every, "keep a drawing for ParaView every N steps")
      ->type_name("N")
      ->check(CLI::Range(1, 1'000'000'000));
  verb.add_flag("--json", options.json, "print summary.json on standard output, and nothing else there");
  verb.add_flag("--quiet", options.quiet, "print nothing but errors (and what --json asks for)");
}

void add_run(CLI::App& program, Work& work) {
  auto options = std::make_shared<RunOptions>();
  CLI::App* verb = program.add_subcommand("run", "one insertion, headless");
  verb->add_option("SCENE", options->scene, "scene file (TOML); docs/scene-keys.md lists its keys")
      ->required();
  add_settings(*verb, options->settings);
  add_output(*verb, options->output);
  add_threads(*verb, options->threads);
  verb->add_option("--record", options->record, "file for a recording, which `acus replay` takes")
      ->type_name("FILE");
  verb->callback([options, verb, &work] {
    options->record_given = verb->count("--record") > 0;
    work = [options] { return do_run(*options); };
  });
}

void add_replay(CLI::App& program, Work& work) {
  auto options = std::make_shared<ReplayOptions>();
  CLI::App* verb =
      program.add_subcommand("replay", "the same bits again, or the same hand with another needle");
  verb->add_option("RECORDING", options->recording, "file that a recording was written into")->required();
  add_settings(*verb, options->settings);
  add_output(*verb, options->output);
  verb->callback([options, &work] { work = [options] { return do_replay(*options); }; });
}

void add_check(CLI::App& program, Work& work) {
  auto options = std::make_shared<CheckOptions>();
  CLI::App* verb =
      program.add_subcommand("check", "explains a scene: mesh, sizes, predicted loads, cost per step");
  verb->add_option("SCENE", options->scene, "scene file (TOML)");
  add_settings(*verb, options->settings);
  verb->add_flag("--keys", options->keys, "print the reference of all scene keys, in Markdown");
  verb->add_flag("--needles", options->needles, "print the table of gauges and materials, as JSON");
  verb->callback([options, &work] { work = [options] { return do_check(*options); }; });
}

void add_bench(CLI::App& program, Work& work) {
  auto options = std::make_shared<BenchOptions>();
  CLI::App* verb = program.add_subcommand("bench", "cost per step by mesh size and part, beside a reference");
  // Tetrahedra. On smaller blocks the reference comes to rest within what doubles can hold, and past it.
  constexpr int fewest = 1000, most = 1000000;
  verb->add_option("--sizes", options->sizes,
                   "tetrahedra aimed at, as in --sizes 1000,10000; 10000 for --insertion")
      ->delimiter(',')
      ->check(CLI::Range(fewest, most))
      ->capture_default_str();
  constexpr int most_steps = 5000;  // the needle that is measured goes no farther
  verb->add_option("--steps", options->steps, "steps measured for each size")
      ->check(CLI::Range(1, most_steps))
      ->capture_default_str();
  verb->add_option(
          "--equal", options->equal,
          "solve to the reference's residual per newton of the load, of the equation for the change of "
          "velocity, or of |b|")
      ->type_name("MEASURE")
      ->check(CLI::IsMember({"load", "change", "momentum"}))
      ->capture_default_str();
  verb->add_option(
          "--element", options->element,
          "the engine's tetrahedra: linear, as the reference's are, or nodal_pressure; the scene's own "
          "without it")
      ->type_name("KIND")
      ->check(CLI::IsMember(std::get<ChoiceField>(find_scene_key("tissue.element")->field).names));
  verb->add_flag(
      "--insertion", options->insertion,
      "measure whole insertions of the default scene instead: in, through buckling and puncture, and "
      "out again");
  add_settings(*verb, options->settings);
  add_threads(*verb, options->threads);
  verb->add_flag("--json", options->json, "print one JSON object and nothing else");
  verb->callback([options, verb, &work] {
    options->sizes_given = verb->count("--sizes") > 0;
    options->steps_given = verb->count("--steps") > 0;
    options->equal_given = verb->count("--equal") > 0;
    work = [options] { return do_bench(*options); };
  });
}

void add_study(CLI::App& program, Work& work) {
  auto options = std::make_shared<StudyOptions>();
  CLI::App* verb = program.add_subcommand("study", "a table of insertions, and a report with plots");
  verb->add_option("STUDY", options->study,
                   "study file (TOML), or the name of a shipped one: paper, fig6, fig7a, ...")
      ->required();
  add_settings(*verb, options->settings);
  verb->add_option("--jobs", options->jobs, "runs at a time; all cores without it")
      ->type_name("N")
      ->check(CLI::Range(1, 1024));
  verb->add_option("--out", options->out,
                   "folder for the table, the report and the runs; out/NAME without it")
      ->type_name("DIR");
  verb->add_option("--figures", options->figures, "folder for the pictures as files; DIR/figures without it")
      ->type_name("DIR");
  verb->add_flag("--resume", options->resume, "keep the runs that this build has finished already");
  verb->add_flag("--quiet", options->quiet, "print nothing but errors");
  verb->callback([options, &work] { work = [options] { return do_study(*options); }; });
}

void add_serve(CLI::App& program, Work& work) {
  auto options = std::make_shared<ServeOptions>();
  CLI::App* verb =
      program.add_subcommand("serve", "the studio on this machine, and a haptic device in the hand");
  verb->add_option("SCENE", options->scene, "scene file (TOML); the defaults without it");
  add_settings(*verb, options->settings);
  verb->add_option("--device", options->device,
                   "as `acus device list` names it; without it a page leads the hand")
      ->type_name("NAME");
  constexpr int last_port = 65535;
  verb->add_option("--port", options->port, "where it listens on this machine; 0: any that is free")
      ->check(CLI::Range(0, last_port))
      ->capture_default_str();
  add_threads(*verb, options->threads);
  verb->add_flag("!--no-browser", options->opens_browser, "do not open a browser");
  verb->add_option("--force-limit", options->force_limit, "most force in N, where less than the device's")
      ->type_name("N")
      ->check(number_from(0.1, 100.0));
  verb->add_option("--seconds", options->seconds, "end after so long; until Ctrl-C without it")
      ->type_name("S")
      ->check(number_from(0.1, 1e6));
  verb->add_option("--record", options->record, "file for a recording, which `acus replay` takes")
      ->type_name("FILE");
  verb->callback([options, verb, &work] {
    options->record_given = verb->count("--record") > 0;
    work = [options] { return do_serve(*options); };
  });
}

void add_emulate(CLI::App& program, Work& work) {
  CLI::App* verb = program.add_subcommand("emulate", "devices that are not there, for whoever has none");
  verb->require_subcommand(1);
  auto options = std::make_shared<EmulateHaplyOptions>();
  CLI::App* haply = verb->add_subcommand("haply", "the Haply Inverse Service with an Inverse3 and a hand");
  constexpr int last_port = 65535;
  haply->add_option("--port", options->port, "where it listens on this machine; 0: any that is free")
      ->check(CLI::Range(0, last_port))
      ->capture_default_str();
  haply->add_option("--service", options->service, "version of the service: 3.1 or 3.5")
      ->check(CLI::IsMember({"3.1", "3.5"}))
      ->capture_default_str();
  constexpr double slowest = 0.1, fastest = 500.0, farthest = 200.0;
  haply->add_option("--speed", options->speed, "of the hand, mm/s")
      ->check(number_from(slowest, fastest))
      ->capture_default_str();
  haply->add_option("--way", options->way, "how far the hand goes before it comes back, mm")
      ->check(number_from(0.0, farthest))
      ->capture_default_str();
  haply
      ->add_option(
          "--fault", options->faults,
          "KIND@SECONDS:FOR_SECONDS after the first message, as in late@3:0.5; the kinds are late, dropped, "
          "malformed, uncalibrated, unplugged, silent; may be repeated")
      ->type_name("FAULT")
      ->allow_extra_args(false);
  haply->add_option("--seconds", options->seconds, "end after so long; until Ctrl-C without it")
      ->type_name("S")
      ->check(number_from(0.1, 1e6));
  haply->callback([options, &work] { work = [options] { return do_emulate_haply(*options); }; });
  verb->add_subcommand("openhaptics", "3D Systems' driver library: says how to use its emulator")
      ->callback([&work] { work = do_emulate_openhaptics; });
  verb->add_subcommand("force_dimension", "Force Dimension's driver library: says how to use its emulator")
      ->callback([&work] { work = do_emulate_force_dimension; });
}

void add_device(CLI::App& program, Work& work) {
  CLI::App* verb = program.add_subcommand("device", "haptic devices: which there are, and whether one works");
  verb->require_subcommand(1);
  verb->add_subcommand("list", "the ways to reach a device, and what each still lacks")->callback([&work] {
    work = do_device_list;
  });
  auto name = std::make_shared<std::string>();
  CLI::App* check =
      verb->add_subcommand("check", "pushes gently with one device and reports rate, jitter and limits");
  check->add_option("NAME", *name, "as `acus device list` names it")->required();
  check->callback([name, &work] { work = [name] { return do_device_check(*name); }; });
}

// What CLI11 says about a word it did not expect does not name the verb that was meant.
std::string misspelt_verb(const CLI::App& program, int argc, char** argv) {
  if (argc < 2 || argv[1][0] == '-') return {};
  std::vector<std::string> verbs;
  for (const CLI::App* verb : program.get_subcommands(nullptr)) verbs.push_back(verb->get_name());
  std::string all;
  for (const std::string& verb : verbs) {
    if (verb == argv[1]) return {};
    all += (all.empty() ? "" : ", ") + verb;
  }
  const std::string near = io::nearest_word(argv[1], verbs);
  return std::string(argv[1]) + " is not a verb; " +
         (near.empty() ? "the verbs are " + all : "did you mean `acus " + near + "`?");
}

int main_with_verbs(int argc, char** argv) {
  CLI::App program("Real-time haptic simulator of flexible needle insertion", "acus");
  program.set_version_flag("--version", "acus " ACUS_VERSION);
  program.require_subcommand(1);
  Work work;
  add_run(program, work);
  add_replay(program, work);
  add_check(program, work);
  add_bench(program, work);
  add_study(program, work);
  add_serve(program, work);
  add_device(program, work);
  add_emulate(program, work);
  try {
    program.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return program.exit(error);  // --help and --version
    const std::string misspelt = misspelt_verb(program, argc, argv);
    return refused((misspelt.empty() ? error.what() : misspelt) +
                       std::string("\nacus --help and acus VERB --help say more"),
                   bad_input);
  }
  const int code = work();
  std::cout.flush();
  if (!std::cout || std::fflush(stdout) != 0 || std::ferror(stdout) != 0)
    return refused("standard output cannot be written to its end", run_failed);
  return code;
}

}  // namespace
}  // namespace acus::app

int main(int argc, char** argv) {
  try {
    return acus::app::main_with_verbs(argc, argv);
  } catch (const std::bad_alloc&) {
    return acus::app::refused("the memory of this machine does not suffice; lower tissue.tetrahedra",
                              acus::app::run_failed);
  } catch (const std::exception& error) {
    return acus::app::refused(std::string("stopped by an error of the program itself: ") + error.what(),
                              acus::app::run_failed);
  }
}
