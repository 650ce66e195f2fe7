#include "acus/io/text_file.h"

#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>

namespace acus::io {

Result<std::string> read_text(const std::string& path, std::size_t most_bytes) {
  namespace fs = std::filesystem;
  std::error_code failed;
  const auto kind = fs::status(path, failed).type();
  if (kind == fs::file_type::not_found) return Error{path + ": there is no such file"};
  if (kind == fs::file_type::directory) return Error{path + ": is a folder; name a file in it"};
  if (kind != fs::file_type::regular) return Error{path + ": is not a regular file that can be read"};
  std::ifstream file(path, std::ios::binary);
  if (!file) return Error{path + ": cannot be read: " + std::strerror(errno)};
  std::string text;
  std::array<char, 1 << 16> part{};
  while (text.size() <= most_bytes && file.read(part.data(), part.size()).gcount() > 0) {
    text.append(part.data(), static_cast<std::size_t>(file.gcount()));
  }
  if (file.bad()) return Error{path + ": cannot be read to its end: " + std::strerror(errno)};
  if (text.size() > most_bytes)
    return Error{path + ": is longer than the " + std::to_string(most_bytes) + " bytes such a file may have"};
  return text;
}

}  // namespace acus::io
