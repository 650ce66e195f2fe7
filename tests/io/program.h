// The built program, run as a user runs it.
#pragma once

#include <string>
#include <vector>

namespace acus::io {

struct ProgramRun {
  int exit_code = 0;  // 128 + signal when it was killed by one
  std::string out, err;
};

// Runs build/.../acus with these words, from the given folder.
ProgramRun run_program(const std::vector<std::string>& words, const std::string& folder);

// A folder of its own for one test, empty.
std::string fresh_folder(const std::string& name);

std::string file_text(const std::string& path);

}  // namespace acus::io
