// The files that the build has put into the program (studio_files.cmake).
#pragma once

#include <span>
#include <string_view>

namespace acus::app {

struct EmbeddedFile {
  std::string_view path;  // "/index.html"
  const char *begin, *end;
};

std::span<const EmbeddedFile> embedded_files();

}  // namespace acus::app
