#include "acus/io/append_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>

#include "acus/io/output_file.h"

namespace acus::io {
namespace {

// The folder knows of the new name even after a power cut; what cannot be synced is no loss otherwise.
void sync_folder_of(const std::string& path) {
  const std::string folder = std::filesystem::path(path).parent_path().string();
  const int descriptor = ::open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) return;
  ::fsync(descriptor);
  ::close(descriptor);
}

}  // namespace

Result<AppendFile> AppendFile::create(const std::string& path, std::string_view beginning,
                                      const std::string& option) {
  namespace fs = std::filesystem;
  std::error_code failed;
  if (fs::exists(path, failed) && !fs::is_regular_file(path, failed))
    return Error{path + ": is no regular file; choose another name with " + option};
  const std::string draft = path + ".part";
  constexpr int anyone_may_read = 0644;
  const int descriptor =
      ::open(draft.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_APPEND | O_CLOEXEC, anyone_may_read);
  if (descriptor < 0) return Error{path + ": cannot be written: " + write_obstacle(errno, option)};
  AppendFile file(path, option, descriptor);
  if (auto incomplete = file.append(beginning)) {
    fs::remove(draft, failed);
    return *incomplete;
  }
  fs::rename(draft, path, failed);
  if (failed) return Error{path + ": cannot be written: " + write_obstacle(failed.value(), option)};
  sync_folder_of(path);
  return file;
}

std::optional<Error> AppendFile::append(std::string_view bytes) {
  const auto obstacle = [this] {
    return Error{path_ + ": cannot be written to its end: " + write_obstacle(errno, option_)};
  };
  while (!bytes.empty()) {
    const ssize_t written = ::write(descriptor_, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return obstacle();
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  if (::fdatasync(descriptor_) != 0) return obstacle();
  return std::nullopt;
}

AppendFile::AppendFile(AppendFile&& other) noexcept
    : path_(std::move(other.path_)), option_(std::move(other.option_)), descriptor_(other.descriptor_) {
  other.descriptor_ = -1;
}

AppendFile::~AppendFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

}  // namespace acus::io
