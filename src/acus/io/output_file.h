// A file being written: the first thing that goes wrong is kept and told by close(), so that nothing is lost
// in silence.
#pragma once

#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "acus/base/result.h"

namespace acus::io {

// Why a file could not be written, from errno; `option` is what a user types to choose another place.
std::string write_obstacle(int error_number, const std::string& option = "--out");

class OutputFile {
 public:
  // Creates the file or empties the one that is there.
  static Result<OutputFile> create(const std::string& path);

  void write(std::string_view text);
  bool failed() const { return failure_.has_value(); }
  // Puts what was written so far where other programs can read it.
  void flush();
  // Ends the file; what went wrong since create(), if anything.
  std::optional<Error> close();

 private:
  struct Closer {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  OutputFile(std::string path, std::FILE* file) : path_(std::move(path)), file_(file) {}
  void note_failure();

  std::string path_;
  std::unique_ptr<std::FILE, Closer> file_;
  std::optional<Error> failure_;
};

// A whole file at once: written beside its place and then put there, so that a full disk or a power cut
// leaves the file that was there before.
std::optional<Error> write_file(const std::string& path, std::string_view text);

// The folder and those above it, made where they are missing.
std::optional<Error> make_folder(const std::string& path);

}  // namespace acus::io
