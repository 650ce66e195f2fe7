// The verbs of the program. Each adds its own options and, when the user chose it, sets `work` to what it
// does; the work returns the exit code.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <string>
#include <vector>

namespace acus::app {

enum ExitCode { done = 0, run_failed = 1, bad_input = 2 };

using Work = std::function<int()>;

void add_run(CLI::App& program, Work& work);
void add_check(CLI::App& program, Work& work);
void add_bench(CLI::App& program, Work& work);
void add_study(CLI::App& program, Work& work);

// "acus: sentence" on standard error; returns `code`.
int refused(const std::string& sentence, ExitCode code);

// The option --set key=value, which may stand many times.
void add_settings(CLI::App& verb, std::vector<std::string>& settings);

}  // namespace acus::app
