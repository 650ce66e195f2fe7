// A driver's library, found while the program runs: acus is built without any maker's kit and ships no
// driver.
#pragma once

#include <optional>
#include <span>
#include <string>

#include "acus/base/result.h"

namespace acus::haptics {

// Where a driver is looked for, and what to tell somebody who does not have it.
struct LibraryPlace {
  const char* variable;                // of the environment: the path to take instead of the names below
  std::span<const char* const> names;  // tried in this order
  const char* owner;                   // "3D Systems' devices"
  const char* remedy;                  // "install OpenHaptics"
};

// Stays loaded for as long as the program runs: a driver may leave threads behind that still run its code.
class SharedLibrary {
 public:
  static Result<SharedLibrary> open(const LibraryPlace& place);

  // Points `function` at the symbol, null where the library has none.
  template <class Function>
  void find(Function*& function, const char* symbol) const {
    function = reinterpret_cast<Function*>(address(symbol));
  }

  // The same for a symbol that we cannot do without; complaint() names the first that was not there.
  template <class Function>
  void require(Function*& function, const char* symbol) {
    find(function, symbol);
    if (!function && missing_.empty()) missing_ = symbol;
  }
  std::optional<Error> complaint() const;

 private:
  SharedLibrary(void* handle, std::string path, const LibraryPlace& place);
  void* address(const char* symbol) const;

  void* handle_;
  std::string path_;
  LibraryPlace place_;
  std::string missing_;
};

}  // namespace acus::haptics
