#include "acus/haptics/shared_library.h"

#include <dlfcn.h>

#include <cstdlib>
#include <utility>
#include <vector>

namespace acus::haptics {
namespace {

std::vector<std::string> paths_of(const LibraryPlace& place) {
  const char* chosen = std::getenv(place.variable);
  if (chosen && *chosen) return {chosen};
  return {place.names.begin(), place.names.end()};
}

std::string remedy_of(const LibraryPlace& place) {
  return std::string(place.remedy) + ", or set " + place.variable + " to the path of its " + place.names[0];
}

}  // namespace

SharedLibrary::SharedLibrary(void* handle, std::string path, const LibraryPlace& place)
    : handle_(handle), path_(std::move(path)), place_(place) {}

Result<SharedLibrary> SharedLibrary::open(const LibraryPlace& place) {
  std::string reasons;
  for (const std::string& path : paths_of(place)) {
    if (void* handle = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL)) return SharedLibrary(handle, path, place);
    const char* reason = dlerror();
    reasons += (reasons.empty() ? "" : "; ") + (reason ? std::string(reason) : path);
  }
  return Error{"the driver of " + std::string(place.owner) + " cannot be loaded (" + reasons +
               "): " + remedy_of(place)};
}

void* SharedLibrary::address(const char* symbol) const { return dlsym(handle_, symbol); }

std::optional<Error> SharedLibrary::complaint() const {
  if (missing_.empty()) return std::nullopt;
  return Error{"the driver " + path_ + " has no function " + missing_ + ", so it is none of " + place_.owner +
               " or too old: " + remedy_of(place_)};
}

}  // namespace acus::haptics
