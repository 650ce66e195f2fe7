// A file that only grows: what was appended is on the disk when append() returns, and stays whatever happens
// to the program afterwards.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "acus/base/result.h"

namespace acus::io {

class AppendFile {
 public:
  // A file of that name and with `beginning` in it. It appears under its name only when the beginning is on
  // the disk; one that stood there is replaced then. `option` is what a user types to choose another name.
  static Result<AppendFile> create(const std::string& path, std::string_view beginning,
                                   const std::string& option);

  // Nothing may be appended after an error: a part of `bytes` may be in the file.
  std::optional<Error> append(std::string_view bytes);

  AppendFile(AppendFile&& other) noexcept;
  AppendFile& operator=(AppendFile&&) = delete;
  ~AppendFile();

 private:
  AppendFile(std::string path, std::string option, int descriptor)
      : path_(std::move(path)), option_(std::move(option)), descriptor_(descriptor) {}

  std::string path_, option_;
  int descriptor_;
};

}  // namespace acus::io
