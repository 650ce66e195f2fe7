// Which verb does the user want? Everything else is in the file of that verb.
#include <cstdio>
#include <exception>
#include <iostream>

#include "acus/io/spelling.h"
#include "verbs.h"

namespace acus::app {

int refused(const std::string& sentence, ExitCode code) {
  std::cerr << "acus: " << sentence << "\n";
  return code;
}

void add_settings(CLI::App& verb, std::vector<std::string>& settings) {
  verb.add_option("--set", settings,
                  "lay a value over the scene, as in --set needle.length_mm=150; may be repeated")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
}

namespace {

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
  add_check(program, work);
  add_bench(program, work);
  add_study(program, work);
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
