#include "program.h"

#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace acus::io {
namespace {

std::string shell_word(const std::string& word) {
  std::ostringstream quoted;
  quoted << '\'';
  for (char c : word)
    quoted << (c == '\'' ? "'\\'" : "") << c;  // a quote: end the quotes, write it, open them again
  quoted << '\'';
  return quoted.str();
}

}  // namespace

std::string file_text(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

std::string fresh_folder(const std::string& name) {
  namespace fs = std::filesystem;
  const fs::path folder = fs::temp_directory_path() / ("acus_" + std::to_string(getpid()) + "_" + name);
  fs::remove_all(folder);
  fs::create_directories(folder);
  return folder.string();
}

ProgramRun run_program(const std::vector<std::string>& words, const std::string& folder) {
  std::ostringstream command;
  command << "cd " << shell_word(folder) << " && " << shell_word(ACUS_BUILD_DIR "/acus");
  for (const std::string& word : words) command << ' ' << shell_word(word);
  command << " > stdout.txt 2> stderr.txt";
  const int status = std::system(command.str().c_str());
  const int code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  return {code, file_text(folder + "/stdout.txt"), file_text(folder + "/stderr.txt")};
}

}  // namespace acus::io
