// The studio's page as it was when the program was built, inside the program.
#pragma once

#include <optional>
#include <string_view>

namespace acus::app {

struct StudioFile {
  std::string_view type, bytes;
};

// `path` begins with a slash. Where the program was built without the studio there is one page that says so.
std::optional<StudioFile> studio_file(std::string_view path);

}  // namespace acus::app
