// Result: a value, or one clear sentence that says what is wrong and what would be right.
#pragma once

#include <cassert>
#include <string>
#include <utility>
#include <variant>

namespace acus {

struct Error {
  std::string sentence;
};

// Used while building and reading; a step never returns one (failures there are Health values).
template <class T>
class [[nodiscard]] Result {
 public:
  Result(T value) : content_(std::move(value)) {}
  Result(Error error) : content_(std::move(error)) {}

  bool ok() const { return content_.index() == 0; }
  explicit operator bool() const { return ok(); }

  T& value() & { return assert(ok()), std::get<0>(content_); }
  const T& value() const& { return assert(ok()), std::get<0>(content_); }
  T&& value() && { return assert(ok()), std::get<0>(std::move(content_)); }
  T& operator*() & { return value(); }
  const T& operator*() const& { return value(); }
  T* operator->() { return &value(); }
  const T* operator->() const { return &value(); }

  const Error& error() const { return assert(!ok()), std::get<1>(content_); }

 private:
  std::variant<T, Error> content_;
};

}  // namespace acus
