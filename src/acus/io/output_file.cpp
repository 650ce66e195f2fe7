#include "acus/io/output_file.h"

#include <cerrno>
#include <cstring>
#include <filesystem>

namespace acus::io {
std::string write_obstacle(int error_number, const std::string& option) {
  if (error_number == ENOSPC) return "the disk is full; free some space or write elsewhere with " + option;
  if (error_number == EACCES || error_number == EROFS || error_number == EPERM)
    return "writing there is not permitted; choose another folder with " + option;
  if (error_number == ENOENT) return "its folder does not exist; make it first";
  if (error_number == EISDIR) return "a folder of that name stands in its place";
  return std::strerror(error_number);
}

Result<OutputFile> OutputFile::create(const std::string& path) {
  std::FILE* file = std::fopen(path.c_str(), "wb");
  if (file == nullptr) return Error{path + ": cannot be written: " + write_obstacle(errno)};
  return OutputFile(path, file);
}

void OutputFile::note_failure() {
  if (!failure_) failure_ = Error{path_ + ": cannot be written to its end: " + write_obstacle(errno)};
}

void OutputFile::write(std::string_view text) {
  if (std::fwrite(text.data(), 1, text.size(), file_.get()) != text.size()) note_failure();
}

void OutputFile::flush() {
  if (std::fflush(file_.get()) != 0) note_failure();
}

std::optional<Error> OutputFile::close() {
  flush();
  if (std::fclose(file_.release()) != 0) note_failure();
  return failure_;
}

std::optional<Error> write_file(const std::string& path, std::string_view text) {
  const std::string draft = path + ".part";
  Result<OutputFile> file = OutputFile::create(draft);
  if (!file) return file.error();
  file->write(text);
  std::error_code failed;
  if (const auto incomplete = file->close()) {
    std::filesystem::remove(draft, failed);
    return incomplete;
  }
  std::filesystem::rename(draft, path, failed);
  if (failed) return Error{path + ": cannot be written: " + write_obstacle(failed.value())};
  return std::nullopt;
}

std::optional<Error> make_folder(const std::string& path) {
  std::error_code failed;
  std::filesystem::create_directories(path, failed);
  std::error_code unknown;  // what cannot be looked at is no folder to write into
  if (std::filesystem::is_directory(path, unknown)) return std::nullopt;
  if (std::filesystem::exists(path, unknown)) return Error{path + ": is a file; name a folder to write into"};
  return Error{path + ": this folder cannot be made: " + write_obstacle(failed.value())};
}

}  // namespace acus::io
