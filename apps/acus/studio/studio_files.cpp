#include "studio_files.h"

#include <array>

#include "studio_file_table.h"

namespace acus::app {
namespace {

struct Type {
  std::string_view ending, name;
};
constexpr std::array types{Type{".html", "text/html; charset=utf-8"},
                           Type{".js", "text/javascript; charset=utf-8"},
                           Type{".mjs", "text/javascript; charset=utf-8"},
                           Type{".css", "text/css; charset=utf-8"},
                           Type{".json", "application/json"},
                           Type{".svg", "image/svg+xml"},
                           Type{".png", "image/png"},
                           Type{".wasm", "application/wasm"}};

constexpr std::string_view without_studio =
    "<!doctype html><html lang=\"en\"><title>acus</title><p>This program was built without the studio: "
    "<code>./dev studio</code> builds it.</p></html>";

std::string_view type_of(std::string_view path) {
  for (const Type& type : types)
    if (path.ends_with(type.ending)) return type.name;
  return "application/octet-stream";
}

}  // namespace

std::optional<StudioFile> studio_file(std::string_view path) {
  for (const EmbeddedFile& file : embedded_files())
    if (file.path == path)
      return StudioFile{type_of(path), {file.begin, static_cast<std::size_t>(file.end - file.begin)}};
  if (path == "/index.html" && embedded_files().empty()) return StudioFile{type_of(path), without_studio};
  return std::nullopt;
}

}  // namespace acus::app
